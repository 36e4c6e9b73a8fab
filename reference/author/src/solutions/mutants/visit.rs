//! Traverses a file's syntax tree and collects the changes of every family.

use syn::visit::{self, Visit};
use syn::{
    Attribute, Expr, ExprBinary, ExprForLoop, ExprIf, ExprMethodCall, ExprPath, ExprStruct,
    ExprUnary, ExprWhile, Ident, ImplItemConst, ImplItemFn, Index, ItemConst, ItemFn, ItemMod,
    ItemStruct, Lit, Local, Pat, Stmt, UnOp,
};

use super::families::{EPSILONS, Visitor, bytes};

/// Groups of names that are easily confused. Each name is replaced with every other name in its
/// group.
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

/// Operators and their replacements.
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

impl<'ast> Visit<'ast> for Visitor<'_> {
    /// Tests aren't part of a solution.
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

    /// Adds changes that leave out single statements, including early returns but not declarations.
    fn visit_stmt(&mut self, statement: &'ast Stmt) {
        if matches!(statement, Stmt::Expr(_, Some(_)) | Stmt::Macro(_)) {
            let what = format!("dropped: {}", self.text(statement));
            self.add(what, bytes(statement), "");
        }
        visit::visit_stmt(self, statement);
    }
}
