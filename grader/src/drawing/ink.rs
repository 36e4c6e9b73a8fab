//! Colours and line styles. Colour is never the only difference: the expected answer is drawn with
//! solid lines and discs, and the submitted answer with dashed lines and crosses.
//!
//! A page may set the custom properties `--right`, `--wrong` and `--paper`, for example for its
//! dark theme. The default colours are from Okabe and Ito, "Color Universal Design", 2008.

/// A colour.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Ink {
    /// The text colour of the page.
    Text,
    /// A lighter shade of the text colour.
    Faint,
    /// The colour of the expected answer.
    Right,
    /// The colour of the submitted answer if it is wrong.
    Wrong,
}

impl Ink {
    /// Returns the SVG paint.
    pub(super) fn paint(self) -> &'static str {
        match self {
            Ink::Text | Ink::Faint => "currentColor",
            Ink::Right => "var(--right, #0072b2)",
            Ink::Wrong => "var(--wrong, #d55e00)",
        }
    }

    /// Returns the opacity, as an SVG value.
    pub(super) fn opacity(self) -> &'static str {
        match self {
            Ink::Text | Ink::Right | Ink::Wrong => "1",
            Ink::Faint => "0.72",
        }
    }
}

/// A line style.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum LineStyle {
    /// The outline of a shape.
    Outline,
    /// A guide line.
    Grid,
    /// A ray ahead of its origin.
    Ray,
    /// The line of a ray behind its origin.
    Behind,
    /// The range of a ray.
    Range,
    /// A line of the expected answer.
    Right,
    /// A line of the submitted answer if it is wrong.
    Wrong,
}

impl LineStyle {
    /// Returns the style as attributes of an SVG element.
    pub(super) fn attributes(self) -> String {
        let (ink, opacity, width, dashes) = match self {
            LineStyle::Outline => (Ink::Text, "1", "1.5", ""),
            LineStyle::Grid => (Ink::Text, "0.3", "1", ""),
            LineStyle::Ray => (Ink::Text, "0.85", "1.5", ""),
            LineStyle::Behind => (Ink::Text, "0.6", "1.2", "1.5 4"),
            LineStyle::Range => (Ink::Text, "0.35", "7", ""),
            LineStyle::Right => (Ink::Right, "1", "2.5", ""),
            LineStyle::Wrong => (Ink::Wrong, "1", "2.5", "6 4"),
        };
        let dashes = match dashes {
            "" => String::new(),
            dashes => format!(r#" stroke-dasharray="{dashes}""#),
        };
        let opacity = match opacity {
            "1" => String::new(),
            opacity => format!(r#" stroke-opacity="{opacity}""#),
        };
        let paint = ink.paint();
        format!(r#"stroke="{paint}"{opacity} stroke-width="{width}"{dashes}"#)
    }
}

/// The fill of an area.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Fill {
    /// No fill.
    None,
    /// A colour with an opacity from 0 to 1.
    Tint(Ink, f64),
}

impl Fill {
    /// Returns the fill as attributes of an SVG element.
    pub(super) fn attributes(self) -> String {
        match self {
            Fill::None => r#"fill="none""#.to_owned(),
            Fill::Tint(ink, share) => {
                let (paint, share) = (ink.paint(), share.clamp(0.0, 1.0));
                format!(r#"fill="{paint}" fill-opacity="{share:.2}""#)
            }
        }
    }
}
