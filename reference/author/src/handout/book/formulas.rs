//! LaTeX in Markdown becomes MathML, which browsers draw by themselves.

use math_core::{LatexToMathML, MathCoreConfig, MathDisplay};

use crate::handout::pages::formulas;

/// A formula that is not understood.
#[derive(Debug, thiserror::Error)]
#[error("{chapter}: the formula `{formula}`: {problem}")]
pub struct FormulaError {
    /// The chapter's title.
    pub chapter: String,
    /// As it stands there.
    pub formula: String,
    /// What is wrong with it.
    pub problem: String,
}

/// The chapter, its formulas as MathML.
pub fn render_formulas(chapter: &str, markdown: &str) -> Result<String, FormulaError> {
    let no_formula = |formula: &str, problem: String| FormulaError {
        chapter: chapter.to_owned(),
        formula: formula.trim().to_owned(),
        problem,
    };
    let converter = LatexToMathML::new(MathCoreConfig::default())
        .map_err(|problem| no_formula("", format!("{problem:?}")))?;
    let mut text = markdown.to_owned();
    // From the end, so that the places before stay what they are.
    for (range, latex, by_itself) in formulas(markdown).into_iter().rev() {
        let display = match by_itself {
            true => MathDisplay::Block,
            false => MathDisplay::Inline,
        };
        let mathml = converter
            .convert_with_local_state(latex.trim(), display)
            .map_err(|problem| no_formula(&latex, problem.to_string()))?;
        let mathml = escape_markdown(&mathml.mathml);
        let html = match by_itself {
            true => format!("<div class=\"formula\">{mathml}</div>\n"),
            false => mathml,
        };
        text.replace_range(range, &html);
    }
    Ok(text)
}

/// Markdown goes on reading between the tags: what it would take for its own is written as a
/// number.
fn escape_markdown(mathml: &str) -> String {
    let mut inside = false;
    let mut shielded = String::with_capacity(mathml.len());
    for letter in mathml.chars().filter(|letter| *letter != '\n') {
        match letter {
            '<' => inside = true,
            '>' => inside = false,
            _ => {}
        }
        if !inside && "*_`[]\\|~'\"".contains(letter) {
            shielded.push_str(&format!("&#{};", u32::from(letter)));
        } else {
            shielded.push(letter);
        }
    }
    shielded
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn renders_formulas_and_keeps_the_rest() {
        let text =
            render_formulas("A", "So $a_1 < b$.\n\n```math\nc^2\n```\n\nAnd `$d$`.").unwrap();
        assert!(text.starts_with("So <math>"), "{text}");
        assert!(
            text.contains("<div class=\"formula\"><math display=\"block\">"),
            "{text}"
        );
        assert!(text.ends_with("And `$d$`."), "{text}");
    }

    #[test]
    fn reports_an_invalid_formula_with_its_chapter() {
        let told = render_formulas("Boxes", "$\\fraction{1}{2}$")
            .unwrap_err()
            .to_string();
        assert!(
            told.starts_with("Boxes: the formula `\\fraction{1}{2}`"),
            "{told}"
        );
    }
}
