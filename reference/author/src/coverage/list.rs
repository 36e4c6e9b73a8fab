//! The list of sentences, the items that ask them, and the reasons for what is not asked.

use serde::Deserialize;

/// The list of sentences and reasons.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct Listed {
    pub sentence: Vec<Sentence>,
    #[serde(default)]
    not_asked: Vec<Reason>,
}

/// A sentence of the contract.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct Sentence {
    /// The task whose method's documentation contains it.
    pub task: String,
    pub text: String,
    /// The items that ask it.
    #[serde(default)]
    pub items: Vec<String>,
    /// The reason why no item asks it.
    pub why_not: Option<String>,
}

/// Classes that are not asked, with the reason.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
struct Reason {
    /// The function, such as `Sphere::hit`.
    function: String,
    /// The aspect; all if there is none.
    aspect: Option<String>,
    /// The classes; all if there are none.
    #[serde(default)]
    classes: Vec<String>,
    /// The columns of the table; all if there are none.
    #[serde(default)]
    columns: Vec<String>,
    why: String,
}

impl Listed {
    /// Returns the reason why a class of an aspect is not asked for what a column counts.
    pub(super) fn reason(
        &self,
        function: &str,
        aspect: &str,
        class: &str,
        column: &str,
    ) -> Option<&str> {
        let names =
            |list: &[String], name: &str| list.is_empty() || list.iter().any(|it| it == name);
        let mut reasons = self.not_asked.iter().filter(|reason| {
            reason.function == function
                && reason.aspect.as_deref().is_none_or(|it| it == aspect)
                && names(&reason.classes, class)
                && names(&reason.columns, column)
        });
        reasons.next().map(|reason| reason.why.as_str())
    }
}
