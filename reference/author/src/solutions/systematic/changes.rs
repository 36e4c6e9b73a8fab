//! The families of changes. Each takes the code that students write, and returns every change of its
//! kind. Changes that do not compile are made all the same, because only the compiler knows types.

use std::ops::Range;

use super::code::{Code, Token};
use super::syntax::{
    Texts, brace_after, closing, end_of_field, end_of_statement, in_literal, operand_after,
    operand_before,
};

/// A change to a file.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct Change {
    /// The family and the change, such as `epsilon: 1e-3 + u after <`.
    pub what: String,
    /// The bytes that are replaced.
    pub bytes: Range<usize>,
    /// The text that replaces them.
    pub now: String,
    /// The name of the function that the change is in.
    pub function: String,
}

/// Names that are easily confused, group by group. Each is replaced with each other of its group.
const CONFUSED: [&[&str]; 18] = [
    &["x", "y", "z"],
    &["min", "max"],
    &["min_element", "max_element"],
    &["p0", "p1", "p2"],
    &["e1", "e2", "s"],
    &["u", "v", "w"],
    &["a", "b", "c"],
    &["near", "far"],
    &["at_min", "at_max"],
    &["enter", "leave"],
    &["l", "r"],
    &["in_l", "in_r"],
    &["first", "second"],
    &["left", "right"],
    &["start", "middle", "end"],
    &["position", "normal", "origin", "dir"],
    &["sin", "cos", "tan"],
    &["floor", "ceil", "round"],
];

/// The sizes of an absolute epsilon.
const EPSILONS: [&str; 4] = ["1e-3", "1e-4", "1e-5", "1e-6"];

/// Returns all changes of all families.
pub(super) fn changes(code: &Code) -> Vec<Change> {
    let families: [fn(&Code) -> Vec<Change>; 9] = [
        epsilons,
        numbers,
        initial_values,
        confused_names,
        swapped_operands,
        dropped_calls,
        dropped_fields,
        conditions,
        dropped_statements,
    ];
    families.iter().flat_map(|family| family(code)).collect()
}

fn change(token: &Token, bytes: Range<usize>, now: String, what: String) -> Change {
    Change {
        what,
        bytes,
        now,
        function: token.function.to_owned(),
    }
}

/// Replaces one token.
fn replace(token: &Token, now: &str, family: &str) -> Change {
    let what = format!("{family}: {} becomes {now}", token.text);
    change(token, token.bytes(), now.to_owned(), what)
}

/// Each comparison with an absolute epsilon: `a < b` becomes `a < 1e-3 + b`, and so on.
fn epsilons(code: &Code) -> Vec<Change> {
    let mut found = Vec::new();
    for (index, token) in code.tokens.iter().enumerate() {
        let is_comparison = matches!(token.text, "<" | ">" | "<=" | ">=") && token.is_apart;
        let is_contains =
            token.text == "(" && index > 0 && code.tokens[index - 1].text == "contains";
        let after = token.bytes().end..token.bytes().end;
        for epsilon in EPSILONS {
            for sign in ["", "-"] {
                if is_comparison || is_contains {
                    let what = format!("epsilon: {sign}{epsilon} after {}", token.text);
                    let now = format!(" {sign}{epsilon} + ");
                    found.push(change(token, after.clone(), now, what));
                }
            }
            if token.text == "==" {
                let left = operand_before(code, index);
                let what = format!(
                    "epsilon: {left} within {epsilon}",
                    left = &code.file[left.clone()]
                );
                let bytes = left.start..token.bytes().end;
                let now = format!("({}).abs() <= {epsilon} + ", &code.file[left]);
                found.push(change(token, bytes, now, what));
            }
        }
    }
    found
}

/// Each number with another one.
fn numbers(code: &Code) -> Vec<Change> {
    let mut found = Vec::new();
    for token in code.tokens.iter().filter(|token| token.is_number) {
        let others = match token.text.parse::<u32>() {
            Ok(number) => {
                let mut others = vec![(number + 1).to_string(), (2 * number + 2).to_string()];
                others.extend((number > 0).then(|| (number - 1).to_string()));
                others
            }
            Err(_) => ["0.0", "1.0", "2.0", "0.5"].map(str::to_owned).to_vec(),
        };
        let others = others.iter().filter(|other| *other != token.text);
        found.extend(others.map(|other| replace(token, other, "number")));
    }
    found
}

/// Each initial value of a variable, and each empty box, with another one.
fn initial_values(code: &Code) -> Vec<Change> {
    let mut found = Vec::new();
    for (index, window) in code.tokens.windows(4).enumerate() {
        match window.map_texts() {
            ["let", "mut", name, "="] => {
                let value = index + 4;
                let end = end_of_statement(code, value);
                if let Some(first) = code.tokens.get(value) {
                    let what = format!("initial value: of {name}");
                    let bytes = first.start..end;
                    let now = "Default::default()".to_owned();
                    found.push(change(&window[0], bytes, now, what));
                }
            }
            ["BBox", "::", "EMPTY", _] => {
                let bytes = window[0].start..window[2].bytes().end;
                let now = "BBox::new(glam::Vec3::ZERO, glam::Vec3::ZERO)".to_owned();
                let what = "initial value: a box at the origin".to_owned();
                found.push(change(&window[0], bytes, now, what));
            }
            _ => {}
        }
    }
    found
}

/// Each name with the others of its group.
fn confused_names(code: &Code) -> Vec<Change> {
    let mut found = Vec::new();
    for token in &code.tokens {
        let groups = CONFUSED.iter().filter(|group| group.contains(&token.text));
        for other in groups.flat_map(|group| group.iter()) {
            if *other != token.text {
                found.push(replace(token, other, "name"));
            }
        }
    }
    found
}

/// The operands of each operator that is not commutative, and of each cross product, swapped.
fn swapped_operands(code: &Code) -> Vec<Change> {
    let mut found = Vec::new();
    for (index, token) in code.tokens.iter().enumerate() {
        let is_operator = matches!(token.text, "-" | "/") && token.is_apart;
        let is_cross = token.text == "cross";
        if !is_operator && !is_cross {
            continue;
        }
        let left = operand_before(code, if is_cross { index - 1 } else { index });
        let right = operand_after(code, if is_cross { index + 2 } else { index + 1 });
        if left.is_empty() || right.is_empty() {
            continue;
        }
        let (first, second) = (&code.file[left.clone()], &code.file[right.clone()]);
        let between = &code.file[left.end..right.start];
        let what = format!("operands: {first} and {second} swapped");
        let now = format!("{second}{between}{first}");
        found.push(change(token, left.start..right.end, now, what));
    }
    found
}

/// Each call of a method without arguments is left out.
fn dropped_calls(code: &Code) -> Vec<Change> {
    let mut found = Vec::new();
    for window in code.tokens.windows(4) {
        if let [".", name, "(", ")"] = window.map_texts() {
            let bytes = window[0].start..window[3].bytes().end;
            let what = format!("dropped: .{name}()");
            found.push(change(&window[1], bytes, String::new(), what));
        }
    }
    found
}

/// Each field of a value that is created gets its default.
fn dropped_fields(code: &Code) -> Vec<Change> {
    let mut found = Vec::new();
    for (index, window) in code.tokens.windows(3).enumerate() {
        let [before, name, after] = window.map_texts();
        let is_field =
            matches!(before, "{" | ",") && window[1].is_name() && in_literal(code, index);
        if !is_field {
            continue;
        }
        let bytes = match after {
            ":" => window[1].start..end_of_field(code, index + 3),
            "," | "}" => window[1].bytes(),
            _ => continue,
        };
        let what = format!("dropped: the field {name}");
        let now = format!("{name}: Default::default()");
        found.push(change(&window[1], bytes, now, what));
    }
    found
}

/// Each condition is always true, or never; each loop ends after its first round.
fn conditions(code: &Code) -> Vec<Change> {
    let mut found = Vec::new();
    for (index, token) in code.tokens.iter().enumerate() {
        let is_let = code
            .tokens
            .get(index + 1)
            .is_some_and(|next| next.text == "let");
        if token.text == "if"
            && !is_let
            && let Some(first) = code.tokens.get(index + 1)
            && let Some(brace) = brace_after(code, index)
        {
            let bytes = first.start..code.tokens[brace].start;
            for value in ["true", "false"] {
                let what = format!("condition: {} is {value}", code.file[bytes.clone()].trim());
                found.push(change(token, bytes.clone(), format!("{value} "), what));
            }
        }
        if matches!(token.text, "for" | "while")
            && let Some(open) = brace_after(code, index)
            && let Some(close) = closing(code, open)
        {
            let at = code.tokens[close].start;
            let what = "condition: a loop ends after its first round".to_owned();
            found.push(change(token, at..at, " break; ".to_owned(), what));
        }
    }
    found
}

/// Each statement that is no declaration is left out, early returns among them.
fn dropped_statements(code: &Code) -> Vec<Change> {
    let mut found = Vec::new();
    let mut begin = 0;
    for (index, token) in code.tokens.iter().enumerate() {
        match token.text {
            "{" | "}" => begin = index + 1,
            ";" => {
                let first = &code.tokens[begin];
                let is_kept = matches!(first.text, "let" | "const" | "struct" | ";");
                if begin < index && !is_kept {
                    let bytes = first.start..token.bytes().end;
                    let what = format!("dropped: {}", &code.file[bytes.clone()]);
                    found.push(change(first, bytes, String::new(), what));
                }
                begin = index + 1;
            }
            _ => {}
        }
    }
    found
}
