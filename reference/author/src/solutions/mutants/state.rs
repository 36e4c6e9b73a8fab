//! Changes that keep state between calls to a method.

use std::ops::Range;

use syn::spanned::Spanned;
use syn::{FnArg, Signature};

/// Types whose values can be copied and kept, whether they are passed by reference or by value.
const COPIED: [&str; 6] = ["Ray", "Interval", "UVec2", "Vec2", "usize", "f32"];

/// A description, the bytes to replace and the replacement.
type StateChange = (String, Range<usize>, String);

/// Returns all changes that keep state in a method. `body` is the range of its code, and `returns`
/// is its return type.
pub(super) fn changes(
    file: &str,
    signature: &Signature,
    body: Range<usize>,
    returns: &str,
) -> Vec<StateChange> {
    let mut changes = Vec::new();
    for argument in &signature.inputs {
        if let FnArg::Typed(argument) = argument {
            let text = |node: &dyn Spanned| file[node.span().byte_range()].to_owned();
            let (name, of_type) = (text(&argument.pat), text(&argument.ty));
            let begin = body.start..body.start;
            let kept = kept_argument(&name, &of_type).into_iter();
            changes.extend(kept.map(|(what, now)| (what, begin.clone(), now)));
        }
    }
    let kept = kept_answers(&file[body.clone()], returns).into_iter();
    changes.extend(kept.map(|(what, now)| (what.to_owned(), body.clone(), now)));
    changes
}

/// Replaces an argument with its value from an earlier call, e.g. the first or the previous one.
fn kept_argument(name: &str, of_type: &str) -> Vec<(String, String)> {
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
            "of an earlier call, updated on every 16th call",
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
        (format!("{name} is that {when}"), body)
    });
    changes.to_vec()
}

/// Repeats an answer, or makes it depend on earlier answers.
fn kept_answers(text: &str, returns: &str) -> Vec<(&'static str, String)> {
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
    let change = |(what, rule): (&'static str, &str)| {
        let now = format!(
            "thread_local! {{\n\
             static KEPT: std::cell::Cell<{returns}> = const {{ std::cell::Cell::new(None) }};\n\
             static COUNT: std::cell::Cell<u32> = const {{ std::cell::Cell::new(0) }};\n}}\n\
             let _ = COUNT.get();\n\
             let answer: {returns} = (|| {{\n{text}}})();\n{rule}\n"
        );
        (what, now)
    };
    kept.into_iter().map(change).collect()
}
