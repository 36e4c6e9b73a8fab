//! Makes a submission's `BBox::hit` and `Primitive::hit` report their calls, without a change in the
//! traversal, which calls them.
//!
//! The method is renamed, and a method with its old name calls it and reports the result. Types and
//! line numbers stay as they are.

use ra_ap_rustc_lexer::{FrontmatterAllowed, TokenKind, tokenize};

/// A method whose calls are recorded.
#[derive(Clone, Copy, Debug)]
pub struct RecordedMethod {
    /// The file.
    pub file: &'static str,
    /// The type.
    type_name: &'static str,
    /// The parameters and the body of the method that takes the name.
    wrapper: &'static str,
}

/// The methods whose calls are recorded.
pub const RECORDED: [RecordedMethod; 2] = [
    RecordedMethod {
        file: "bbox.rs",
        type_name: "BBox",
        wrapper: "(&self, ray: &::protocol::Ray, times: ::protocol::Interval) \
            -> ::core::option::Option<::protocol::Interval> { \
            let inside = self.hit_as_written(ray, times); \
            ::view_probe::record::box_test(self, [self.min, self.max], times, inside) }",
    },
    RecordedMethod {
        file: "primitive.rs",
        type_name: "Primitive",
        wrapper: "(&self, ray: &::protocol::Ray) \
            -> ::core::option::Option<::protocol::Trace> { \
            let hit = self.hit_as_written(ray); \
            ::view_probe::record::primitive_test(self.material(), ray, hit) }",
    },
];

impl RecordedMethod {
    /// Returns the text of the file in which calls of the method are recorded, or `None` if it has
    /// no such method.
    pub fn apply(&self, text: &str) -> Option<String> {
        let name = find_hit(text, self.type_name)?;
        let (before, after) = (&text[..name], &text[name + "hit".len()..]);
        Some(format!(
            "{before}hit{} fn hit_as_written{after}",
            self.wrapper
        ))
    }
}

/// Returns the position of the name of the method `hit` in the type's own `impl` block.
fn find_hit(text: &str, type_name: &str) -> Option<usize> {
    let mut position = 0;
    let tokens = tokenize(text, FrontmatterAllowed::No).filter_map(|token| {
        let start = position;
        position += token.len as usize;
        let is_code = !matches!(
            token.kind,
            TokenKind::Whitespace | TokenKind::LineComment { .. } | TokenKind::BlockComment { .. }
        );
        is_code.then_some((start, text.get(start..position)?))
    });
    let tokens: Vec<(usize, &str)> = tokens.collect();
    let mut depth = 0_usize;
    let mut is_inside = false;
    for (index, (_, token)) in tokens.iter().enumerate() {
        let texts = |from: usize, count: usize| -> Vec<&str> {
            let range = tokens.iter().skip(from).take(count);
            range.map(|(_, token)| *token).collect()
        };
        match *token {
            "impl" if depth == 0 => is_inside = texts(index + 1, 2) == [type_name, "{"],
            "{" => depth += 1,
            "}" => {
                depth = depth.saturating_sub(1);
                is_inside &= depth > 0;
            }
            "fn" if is_inside && depth == 1 && texts(index + 1, 2) == ["hit", "("] => {
                return Some(tokens[index + 1].0);
            }
            _ => {}
        }
    }
    None
}

#[cfg(test)]
mod tests {
    use grader::handed_out::RAYS;

    use super::*;

    #[test]
    fn the_method_keeps_its_line_and_its_doc_comment() {
        let bbox = RAYS.task_file("bbox.rs").unwrap().starter;
        let recorded = RECORDED[0].apply(bbox).unwrap();
        assert_eq!(recorded.lines().count(), bbox.lines().count());
        assert!(recorded.contains("} fn hit_as_written(&self, ray: &Ray, times: Interval)"));
        let primitive = RAYS.given_file("primitive.rs").unwrap().text;
        let recorded = RECORDED[1].apply(primitive).unwrap();
        assert!(recorded.contains("pub fn hit(&self, ray: &::protocol::Ray)"));
    }

    #[test]
    fn finds_only_the_method_of_the_type_itself() {
        let text = "// impl BBox { fn hit(\nimpl Other for BBox { fn hit(&self) {} }\n\
            impl BBox { fn a() { fn hit() {} } }\nmod m { impl BBox { fn hit() {} } }\n\
            impl BBox { fn b() -> &'static str { \"fn hit(\" } #[inline] pub fn /* x */ hit (self) {} }";
        let found = find_hit(text, "BBox").unwrap();
        assert!(text[found..].starts_with("hit (self)"));
        assert_eq!(find_hit("impl BBox { fn hits(&self) {} }", "BBox"), None);
        assert_eq!(find_hit("impl BBox { } } } fn hit(", "BBox"), None);
    }
}
