//! The families of changes, found in one traversal of a file's syntax tree. Changes that do not compile
//! are made all the same, because only the compiler knows types.

use std::ops::Range;

use syn::spanned::Spanned;
use syn::visit::{self, Visit};
use syn::{
    Attribute, Block, Expr, ExprBinary, ExprForLoop, ExprIf, ExprMethodCall, ExprPath, ExprStruct,
    ExprUnary, ExprWhile, Ident, ImplItemConst, ImplItemFn, Index, ItemConst, ItemFn, ItemMod,
    ItemStruct, Lit, Local, Pat, ReturnType, Signature, Stmt, UnOp,
};

use super::state;

/// The line before the code that students write.
const BEGIN: &str = "// solution";
/// The line after it.
const END: &str = "// end solution";

/// A change to a file.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct Change {
    /// The family and the change, such as `epsilon: 1e-3 after <`.
    pub what: String,
    /// The bytes that are replaced.
    pub bytes: Range<usize>,
    /// The text that replaces them.
    pub now: String,
    /// The name of the function, constant or type that the change is in.
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

/// Operators, each with those that replace it.
const OPERATORS: [(&str, &[&str]); 16] = [
    ("==", &["!="]),
    ("!=", &["=="]),
    ("<", &["==", ">", "<="]),
    (">", &["==", "<", ">="]),
    ("<=", &[">"]),
    (">=", &["<"]),
    ("&&", &["||"]),
    ("||", &["&&"]),
    ("+", &["-", "*"]),
    ("-", &["+", "/"]),
    ("*", &["+", "/"]),
    ("/", &["*", "%"]),
    ("+=", &["-=", "*="]),
    ("-=", &["+=", "/="]),
    ("*=", &["+=", "/="]),
    ("/=", &["*=", "%="]),
];

/// The sizes of an absolute epsilon.
const EPSILONS: [&str; 4] = ["1e-3", "1e-4", "1e-5", "1e-6"];

/// Returns all changes to a file, in the order of the file. Operators and bodies change everywhere but
/// in tests; everything else only in the code that students write.
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
    // A name that is both a field and its value is visited twice.
    found.dedup();
    Ok(found)
}

/// Returns the bytes of the code that students write: everything between two marked lines.
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
struct Visitor<'a> {
    file: &'a str,
    own: Vec<Range<usize>>,
    function: String,
    found: Vec<Change>,
}

fn bytes(node: &impl Spanned) -> Range<usize> {
    node.span().byte_range()
}

impl<'a> Visitor<'a> {
    fn text(&self, node: &impl Spanned) -> &'a str {
        &self.file[bytes(node)]
    }

    fn is_own(&self, bytes: &Range<usize>) -> bool {
        let mut own = self.own.iter();
        own.any(|own| own.start <= bytes.start && bytes.end <= own.end)
    }

    /// Adds a change anywhere in the file.
    fn add_anywhere(&mut self, what: String, bytes: Range<usize>, now: &str) {
        self.found.push(Change {
            what,
            bytes,
            now: now.to_owned(),
            function: self.function.clone(),
        });
    }

    /// Adds a change, if it is in the code that students write.
    fn add(&mut self, what: String, bytes: Range<usize>, now: &str) {
        if self.is_own(&bytes) {
            self.add_anywhere(what, bytes, now);
        }
    }

    /// Visits an item. Its changes are named after it.
    fn visit_item_named(&mut self, name: &Ident, visit: impl FnOnce(&mut Self)) {
        let outer = std::mem::replace(&mut self.function, name.to_string());
        visit(self);
        self.function = outer;
    }

    /// Replaces a function's body, and keeps state between its calls.
    fn change_function(&mut self, signature: &Signature, block: &Block) {
        let (Some(first), Some(last)) = (block.stmts.first(), block.stmts.last()) else {
            return;
        };
        let body = bytes(first).start..bytes(last).end;
        let returns = match &signature.output {
            ReturnType::Default => "()".to_owned(),
            ReturnType::Type(_, returned) => self.text(returned).split_whitespace().collect(),
        };
        // There is no default that would be simpler than a constructor.
        if signature.ident != "new" {
            for now in default_values(&returns) {
                self.add_anywhere(format!("body: {now}"), body.clone(), now);
            }
        }
        // The body, not a helper that students write as a whole, and without given code after it.
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

    /// Compares with an absolute epsilon: `a < b` becomes `a < 1e-3 + b`, and so on. `at` is the byte
    /// after the operator or parenthesis.
    fn add_epsilons(&mut self, after: &str, at: usize) {
        for epsilon in EPSILONS {
            for sign in ["", "-"] {
                let what = format!("epsilon: {sign}{epsilon} after {after}");
                self.add(what, at..at, &format!(" {sign}{epsilon} + "));
            }
        }
    }

    /// Swaps two operands.
    fn swap(&mut self, left: &Expr, right: &Expr) {
        let (first, second) = (bytes(left), bytes(right));
        let between = &self.file[first.end..second.start];
        let (left, right) = (self.text(left), self.text(right));
        let what = format!("operands: {left} and {right} swapped");
        let now = format!("{right}{between}{left}");
        self.add(what, first.start..second.end, &now);
    }

    /// Replaces a number with others.
    fn change_number(&mut self, node: &impl Spanned) {
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

    /// Ends a loop after its first round.
    fn end_loop(&mut self, body: &Block) {
        let at = body.brace_token.span.close().byte_range().start;
        let what = "condition: a loop ends after its first round";
        self.add(what.to_owned(), at..at, " break; ");
    }
}

/// Returns values of a type that a function can always return.
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

impl<'ast> Visit<'ast> for Visitor<'_> {
    /// Tests are no part of a solution.
    fn visit_item_mod(&mut self, _: &'ast ItemMod) {}

    fn visit_attribute(&mut self, _: &'ast Attribute) {}

    fn visit_item_fn(&mut self, item: &'ast ItemFn) {
        self.visit_item_named(&item.sig.ident, |visitor| {
            visitor.change_function(&item.sig, &item.block);
            visit::visit_item_fn(visitor, item);
        });
    }

    fn visit_impl_item_fn(&mut self, item: &'ast ImplItemFn) {
        self.visit_item_named(&item.sig.ident, |visitor| {
            visitor.change_function(&item.sig, &item.block);
            visit::visit_impl_item_fn(visitor, item);
        });
    }

    fn visit_item_const(&mut self, item: &'ast ItemConst) {
        self.visit_item_named(&item.ident, |visitor| {
            visit::visit_item_const(visitor, item);
        });
    }

    fn visit_impl_item_const(&mut self, item: &'ast ImplItemConst) {
        self.visit_item_named(&item.ident, |visitor| {
            visit::visit_impl_item_const(visitor, item);
        });
    }

    fn visit_item_struct(&mut self, item: &'ast ItemStruct) {
        self.visit_item_named(&item.ident, |visitor| {
            visit::visit_item_struct(visitor, item);
        });
    }

    fn visit_expr_binary(&mut self, binary: &'ast ExprBinary) {
        let operator = self.text(&binary.op);
        let at = bytes(&binary.op);
        let others = OPERATORS.iter().find(|(known, _)| *known == operator);
        for other in others.into_iter().flat_map(|(_, others)| *others) {
            let what = format!("operator: {operator} becomes {other}");
            self.add_anywhere(what, at.clone(), other);
        }
        match operator {
            "<" | ">" | "<=" | ">=" => self.add_epsilons(operator, at.end),
            "==" => {
                let left = self.text(&binary.left);
                for epsilon in EPSILONS {
                    let what = format!("epsilon: {left} within {epsilon}");
                    let now = format!("({left}).abs() <= {epsilon} + ");
                    self.add(what, bytes(&binary.left).start..at.end, &now);
                }
            }
            "-" | "/" => self.swap(&binary.left, &binary.right),
            _ => {}
        }
        visit::visit_expr_binary(self, binary);
    }

    fn visit_expr_unary(&mut self, unary: &'ast ExprUnary) {
        if !matches!(unary.op, UnOp::Deref(_)) {
            let what = format!("operator: {} left out", self.text(&unary.op));
            self.add_anywhere(what, bytes(&unary.op), "");
        }
        visit::visit_expr_unary(self, unary);
    }

    fn visit_expr_method_call(&mut self, call: &'ast ExprMethodCall) {
        let arguments: Vec<&Expr> = call.args.iter().collect();
        let (open, close) = (
            call.paren_token.span.open().byte_range(),
            call.paren_token.span.close().byte_range(),
        );
        match (call.method.to_string().as_str(), &arguments[..]) {
            (name, []) => {
                let call = bytes(&call.dot_token).start..close.end;
                self.add(format!("dropped: .{name}()"), call, "");
            }
            ("cross", [other]) => self.swap(&call.receiver, other),
            ("contains", _) => self.add_epsilons("(", open.end),
            _ => {}
        }
        visit::visit_expr_method_call(self, call);
    }

    fn visit_lit(&mut self, literal: &'ast Lit) {
        if matches!(literal, Lit::Int(_) | Lit::Float(_)) {
            self.change_number(literal);
        }
    }

    fn visit_index(&mut self, index: &'ast Index) {
        self.change_number(index);
    }

    fn visit_ident(&mut self, name: &'ast Ident) {
        let is = |other: &&str| name == *other;
        for group in CONFUSED.iter().filter(|group| group.iter().any(is)) {
            for other in group.iter().filter(|other| !is(other)) {
                self.add(format!("name: {name} becomes {other}"), bytes(name), other);
            }
        }
    }

    fn visit_local(&mut self, local: &'ast Local) {
        if let (Pat::Ident(name), Some(value)) = (&local.pat, &local.init)
            && name.mutability.is_some()
        {
            let what = format!("initial value: of {}", name.ident);
            self.add(what, bytes(&value.expr), "Default::default()");
        }
        visit::visit_local(self, local);
    }

    fn visit_expr_path(&mut self, path: &'ast ExprPath) {
        if self.text(path) == "BBox::EMPTY" {
            let what = "initial value: a box at the origin".to_owned();
            let now = "BBox::new(glam::Vec3::ZERO, glam::Vec3::ZERO)";
            self.add(what, bytes(path), now);
        }
        visit::visit_expr_path(self, path);
    }

    fn visit_expr_struct(&mut self, value: &'ast ExprStruct) {
        for field in &value.fields {
            let name = self.text(&field.member);
            let now = format!("{name}: Default::default()");
            self.add(format!("dropped: the field {name}"), bytes(field), &now);
        }
        visit::visit_expr_struct(self, value);
    }

    fn visit_expr_if(&mut self, branch: &'ast ExprIf) {
        if !matches!(*branch.cond, Expr::Let(_)) {
            for value in ["true", "false"] {
                let what = format!("condition: {} is {value}", self.text(&branch.cond));
                self.add(what, bytes(&branch.cond), value);
            }
        }
        visit::visit_expr_if(self, branch);
    }

    fn visit_expr_for_loop(&mut self, round: &'ast ExprForLoop) {
        self.end_loop(&round.body);
        visit::visit_expr_for_loop(self, round);
    }

    fn visit_expr_while(&mut self, round: &'ast ExprWhile) {
        self.end_loop(&round.body);
        visit::visit_expr_while(self, round);
    }

    /// Leaves out each statement that is no declaration, early returns among them.
    fn visit_stmt(&mut self, statement: &'ast Stmt) {
        if matches!(statement, Stmt::Expr(_, Some(_)) | Stmt::Macro(_)) {
            let what = format!("dropped: {}", self.text(statement));
            self.add(what, bytes(statement), "");
        }
        visit::visit_stmt(self, statement);
    }
}
