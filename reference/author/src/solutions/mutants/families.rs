//! The families of changes. Some of the changes don't compile, because this code doesn't know the
//! types of expressions.

use std::ops::Range;

use syn::spanned::Spanned;
use syn::visit::Visit;
use syn::{Block, Expr, Ident, ReturnType, Signature};

use super::state;

/// The line before the code that students write.
const BEGIN: &str = "// solution";
/// The line after the code that students write.
const END: &str = "// end solution";

/// A change to a file.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct Change {
    /// The family and the change, such as `epsilon: 1e-3 after <`.
    pub what: String,
    /// The bytes to replace.
    pub bytes: Range<usize>,
    /// The replacement.
    pub now: String,
    /// The name of the function, constant or type that contains the change.
    pub function: String,
}

/// The values of an absolute epsilon.
pub(super) const EPSILONS: [&str; 4] = ["1e-3", "1e-4", "1e-5", "1e-6"];

/// Returns all changes to a file, sorted by their position. Operators and bodies are changed
/// everywhere except in tests. Everything else is only changed in the code that students write.
pub(super) fn changes(file: &str) -> syn::Result<Vec<Change>> {
    let mut visitor = Visitor {
        file,
        own: own_code(file),
        function: String::new(),
        found: Vec::new(),
    };
    visitor.visit_file(&syn::parse_file(file)?);
    let mut found = visitor.found;
    found.sort_by(|a, b| {
        let key = |change: &Change| (change.bytes.start, change.bytes.end);
        (key(a), &a.what, &a.now).cmp(&(key(b), &b.what, &b.now))
    });
    // In a field initialised by shorthand, the name is visited twice: as the field and as its
    // value.
    found.dedup();
    Ok(found)
}

/// Returns the byte ranges of the code that students write, which is between marker lines.
fn own_code(file: &str) -> Vec<Range<usize>> {
    let mut own = Vec::new();
    let (mut start, mut begin) = (0, None);
    for line in file.split_inclusive('\n') {
        let end = start + line.len();
        match line.trim() {
            BEGIN => begin = Some(end),
            END => own.extend(begin.take().map(|begin| begin..start)),
            _ => {}
        }
        start = end;
    }
    own
}

/// Collects the changes to a file.
pub(super) struct Visitor<'a> {
    file: &'a str,
    own: Vec<Range<usize>>,
    function: String,
    found: Vec<Change>,
}

/// Returns the byte range of a syntax tree node.
pub(super) fn bytes(node: &impl Spanned) -> Range<usize> {
    node.span().byte_range()
}

impl<'a> Visitor<'a> {
    pub(super) fn text(&self, node: &impl Spanned) -> &'a str {
        &self.file[bytes(node)]
    }

    fn is_own(&self, bytes: &Range<usize>) -> bool {
        let mut own = self.own.iter();
        own.any(|own| own.start <= bytes.start && bytes.end <= own.end)
    }

    /// Adds a change anywhere in the file.
    pub(super) fn add_anywhere(&mut self, what: String, bytes: Range<usize>, now: &str) {
        self.found.push(Change {
            what,
            bytes,
            now: now.to_owned(),
            function: self.function.clone(),
        });
    }

    /// Adds a change if it is in the code that students write.
    pub(super) fn add(&mut self, what: String, bytes: Range<usize>, now: &str) {
        if self.is_own(&bytes) {
            self.add_anywhere(what, bytes, now);
        }
    }

    /// Visits an item. The changes inside it are listed under its name.
    pub(super) fn visit_item_named(&mut self, name: &Ident, visit: impl FnOnce(&mut Self)) {
        let outer = std::mem::replace(&mut self.function, name.to_string());
        visit(self);
        self.function = outer;
    }

    /// Adds changes that replace a function's body or keep state between calls to it.
    pub(super) fn change_function(&mut self, signature: &Signature, block: &Block) {
        let (Some(first), Some(last)) = (block.stmts.first(), block.stmts.last()) else {
            return;
        };
        let body = bytes(first).start..bytes(last).end;
        let returns = match &signature.output {
            ReturnType::Default => "()".to_owned(),
            ReturnType::Type(_, returned) => self.text(returned).split_whitespace().collect(),
        };
        // Keep the bodies of constructors, because a default value wouldn't be any simpler.
        if signature.ident != "new" {
            for now in default_values(&returns) {
                self.add_anywhere(format!("body: {now}"), body.clone(), now);
            }
        }
        // Replace only the part of the body that students write, and keep given code after it.
        let statements = block.stmts.iter().map(bytes);
        let own: Vec<_> = statements.filter(|it| self.is_own(it)).collect();
        if let [first, ..] = &own[..]
            && !self.is_own(&bytes(&block))
        {
            let body = first.start..own[own.len() - 1].end;
            for (what, bytes, now) in state::changes(self.file, signature, body, &returns) {
                self.add(format!("state: {what}"), bytes, &now);
            }
        }
    }

    /// Adds comparisons with an absolute epsilon: `a < b` becomes `a < 1e-3 + b` and so on. `at` is
    /// the position of the byte after the operator or parenthesis.
    pub(super) fn add_epsilons(&mut self, after: &str, at: usize) {
        for epsilon in EPSILONS {
            for sign in ["", "-"] {
                let what = format!("epsilon: {sign}{epsilon} after {after}");
                self.add(what, at..at, &format!(" {sign}{epsilon} + "));
            }
        }
    }

    /// Adds a change that swaps two operands.
    pub(super) fn swap(&mut self, left: &Expr, right: &Expr) {
        let (first, second) = (bytes(left), bytes(right));
        let between = &self.file[first.end..second.start];
        let (left, right) = (self.text(left), self.text(right));
        let what = format!("operands: {left} and {right} swapped");
        let now = format!("{right}{between}{left}");
        self.add(what, first.start..second.end, &now);
    }

    /// Adds changes that replace a number.
    pub(super) fn change_number(&mut self, node: &impl Spanned) {
        let text = self.text(node);
        let others = match text.parse::<u32>() {
            Ok(0) => vec!["1".to_owned(), "2".to_owned()],
            Ok(number) => [number - 1, number + 1, 2 * number + 2]
                .map(|other| other.to_string())
                .to_vec(),
            Err(_) => ["0.0", "1.0", "2.0", "0.5"].map(str::to_owned).to_vec(),
        };
        for other in others.iter().filter(|other| *other != text) {
            self.add(
                format!("number: {text} becomes {other}"),
                bytes(node),
                other,
            );
        }
    }

    /// Adds a change that ends a loop after its first iteration.
    pub(super) fn end_loop(&mut self, body: &Block) {
        let at = body.brace_token.span.close().byte_range().start;
        let what = "condition: a loop ends after its first iteration";
        self.add(what.to_owned(), at..at, " break; ");
    }
}

/// Returns values that any function with this return type can return.
fn default_values(of_type: &str) -> &[&str] {
    match of_type {
        "()" => &["()"],
        "bool" => &["true", "false"],
        "f32" => &["0.0", "1.0", "-1.0"],
        "usize" => &["0", "1"],
        option if option.starts_with("Option<") => &["None", "Some(Default::default())"],
        _ => &["Default::default()"],
    }
}
