//! What the handout's names are looked up in.

/// A source file: where it stands, and its text.
#[derive(Clone, Debug)]
pub struct SourceFile {
    /// From the workspace's root, with `/`.
    pub path: String,
    /// All of it.
    pub text: String,
}
