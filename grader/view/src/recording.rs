//! Makes a submission's `BBox::hit` and `Primitive::hit` report each call, without changing the
//! traversal that calls them.
//!
//! Each of these methods is renamed, and a new method with the old name calls it and reports the
//! result. Types and line numbers stay unchanged.

use grader::handed_out::find_method;

/// A method that is changed so that each call to it is reported.
#[derive(Clone, Copy, Debug)]
pub struct RecordedMethod {
    /// The file.
    pub file: &'static str,
    /// The type.
    type_name: &'static str,
    /// The parameters and the body of the new method that takes over the name `hit`.
    wrapper: &'static str,
}

/// The methods that are changed so that each call to them is reported.
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
            ::view_probe::record::primitive_test(self.number(), ray, hit) }",
    },
];

impl RecordedMethod {
    /// Returns the file's text, changed so that calls to the method are recorded, or `None` if the
    /// method doesn't exist.
    pub fn apply(&self, text: &str) -> Option<String> {
        let path = format!("{}::hit", self.type_name);
        let name = find_method(text, &path).ok()?.name_start;
        let (before, after) = (&text[..name], &text[name + "hit".len()..]);
        Some(format!(
            "{before}hit{} fn hit_as_written{after}",
            self.wrapper
        ))
    }
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
    fn only_the_method_of_the_type_itself_is_renamed() {
        let text = "impl Other for BBox { fn hit(&self) {} }\n\
            impl BBox { fn b() { \"fn hit(\"; } #[inline] pub fn /* x */ hit (self) {} }";
        let recorded = RECORDED[0].apply(text).unwrap();
        assert!(recorded.contains("#[inline] pub fn /* x */ hit(&self, ray: "));
        assert!(recorded.ends_with("fn hit_as_written (self) {} }"));
        assert_eq!(RECORDED[0].apply("impl BBox { fn hits(&self) {} }"), None);
    }
}
