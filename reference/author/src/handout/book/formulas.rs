//! Converts the LaTeX formulas in Markdown to MathML, which browsers render without a script.

use anyhow::{Result, anyhow};
use math_core::{LatexToMathML, MathCoreConfig, MathDisplay};

use crate::handout::pages::Page;

/// Returns the chapter with its formulas converted to MathML.
pub fn render_formulas(chapter: &str, markdown: &str) -> Result<String> {
    let formula_error = |formula: &str, problem: String| {
        let formula = formula.trim();
        anyhow!("{chapter}: the formula `{formula}`: {problem}; correct the formula in handout/src")
    };
    let converter = LatexToMathML::new(MathCoreConfig::default())
        .map_err(|problem| formula_error("", format!("{problem:?}")))?;
    let mut text = markdown.to_owned();
    // Start from the end, so that the ranges of earlier formulas stay valid.
    let formulas = Page::new(chapter, markdown).formulas;
    for (range, latex, is_display) in formulas.into_iter().rev() {
        let display = if is_display {
            MathDisplay::Block
        } else {
            MathDisplay::Inline
        };
        let mathml = converter
            .convert_with_local_state(latex.trim(), display)
            .map_err(|problem| formula_error(&latex, problem.to_string()))?;
        let mathml = escape_markdown(&mathml.mathml);
        let html = if is_display {
            format!("<div class=\"formula\">{mathml}</div>\n")
        } else {
            mathml
        };
        text.replace_range(range, &html);
    }
    Ok(text)
}

/// Escapes characters that are special in Markdown as numeric character references, because text
/// between MathML tags is also parsed as Markdown.
fn escape_markdown(mathml: &str) -> String {
    let mut inside = false;
    let mut escaped = String::with_capacity(mathml.len());
    for letter in mathml.chars().filter(|letter| *letter != '\n') {
        match letter {
            '<' => inside = true,
            '>' => inside = false,
            _ => {}
        }
        if !inside && "*_`[]\\|~'\"".contains(letter) {
            escaped.push_str(&format!("&#{};", u32::from(letter)));
        } else {
            escaped.push(letter);
        }
    }
    escaped
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
        let message = render_formulas("Boxes", "$\\fraction{1}{2}$")
            .unwrap_err()
            .to_string();
        assert!(
            message.starts_with("Boxes: the formula `\\fraction{1}{2}`"),
            "{message}"
        );
    }
}
