//! Changes that keep a state between calls of a method.

use super::changes::Change;
use super::code::{Code, Signature};

/// Types of which a copy can be kept, by reference or by value.
const COPIED: [&str; 6] = ["Ray", "Interval", "UVec2", "Vec2", "usize", "f32"];

/// Returns all changes of a method's body that keep a state.
pub(super) fn changes(code: &Code) -> Vec<Change> {
    let Some(signature) = &code.signature else {
        return Vec::new();
    };
    let parameters = signature.parameters.iter();
    let arguments =
        parameters.flat_map(|(name, of_type)| kept_argument(code, signature, name, of_type));
    arguments.chain(kept_answers(code, signature)).collect()
}

/// An argument is that of the first call, or of the call before.
fn kept_argument(code: &Code, signature: &Signature, name: &str, of_type: &str) -> Vec<Change> {
    let value_type = of_type.trim_start_matches('&');
    if !COPIED.contains(&value_type) {
        return Vec::new();
    }
    let (take, give) = if of_type.starts_with('&') {
        (format!("*{name}"), "&kept")
    } else {
        (name.to_owned(), "kept")
    };
    let kept = [
        ("of the first call", "before"),
        ("of the call before", "now"),
        (
            "of the last call but every 16th",
            "if count % 16 == 0 { now } else { before }",
        ),
    ];
    let changes = kept.map(|(when, next)| {
        let body = format!(
            "thread_local! {{ static KEPT: std::cell::Cell<Option<({value_type}, u32)>> = \
             const {{ std::cell::Cell::new(None) }}; }}\n\
             let now = {take};\n\
             let (before, count) = KEPT.get().unwrap_or((now, 0));\n\
             KEPT.set(Some(({next}, count.wrapping_add(1))));\n\
             let kept = before;\n\
             let _ = count;\n\
             let {name} = {give};\n"
        );
        insert(code, signature, &body, &format!("{name} is that {when}"))
    });
    changes.to_vec()
}

/// An answer is repeated, or changed by the answers before.
fn kept_answers(code: &Code, signature: &Signature) -> Vec<Change> {
    let returns = &signature.returns;
    if !returns.starts_with("Option<") {
        return Vec::new();
    }
    let mut kept = vec![
        (
            "a miss repeats the last hit",
            "if answer.is_none() { return KEPT.get(); }\nKEPT.set(answer);\nanswer",
        ),
        (
            "the first hit is repeated for ever",
            "if KEPT.get().is_some() { return KEPT.get(); }\nKEPT.set(answer);\nanswer",
        ),
        (
            "a hit after a hit is a miss",
            "let before = KEPT.replace(answer);\nif before.is_some() { return None; }\nanswer",
        ),
        (
            "every 64th call repeats the answer before",
            "COUNT.set(COUNT.get() + 1);\n\
             if COUNT.get() % 64 == 0 { return KEPT.get(); }\nKEPT.set(answer);\nanswer",
        ),
        (
            "no hit after a thousand calls",
            "COUNT.set(COUNT.get() + 1);\nif COUNT.get() > 1000 { return None; }\nanswer",
        ),
    ];
    if returns == "Option<Trace>" {
        kept.push((
            "hits beyond the closest of all calls are misses",
            "let closest = KEPT.get();\n\
             if let (Some(closest), Some(hit)) = (closest, answer) && hit.distance > closest.distance \
             { return None; }\nif answer.is_some() { KEPT.set(answer); }\nanswer",
        ));
        kept.push((
            "the normal is that of the hit before",
            "let before = KEPT.replace(answer);\n\
             match (answer, before) { (Some(hit), Some(before)) => \
             Some(Trace { normal: before.normal, ..hit }), (answer, _) => answer }",
        ));
    }
    let text = &code.file[code.bytes.clone()];
    let change = |(what, rule): (&str, &str)| Change {
        what: format!("state: {what}"),
        bytes: code.bytes.clone(),
        now: format!(
            "thread_local! {{\n\
             static KEPT: std::cell::Cell<{returns}> = const {{ std::cell::Cell::new(None) }};\n\
             static COUNT: std::cell::Cell<u32> = const {{ std::cell::Cell::new(0) }};\n}}\n\
             let _ = COUNT.get();\n\
             let answer: {returns} = (|| {{\n{text}}})();\n{rule}\n"
        ),
        function: signature.name.clone(),
    };
    kept.into_iter().map(change).collect()
}

fn insert(code: &Code, signature: &Signature, body: &str, what: &str) -> Change {
    Change {
        what: format!("state: {what}"),
        bytes: code.bytes.start..code.bytes.start,
        now: body.to_owned(),
        function: signature.name.clone(),
    }
}
