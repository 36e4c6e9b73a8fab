//! How things look. Never by colour alone: what is wanted is solid and a disc, what was got is
//! dashed and a cross.
//!
//! A page sets the custom properties `--right`, `--wrong` and `--paper` for its dark side; without
//! them the colours are those of Okabe and Ito, "Color Universal Design", 2008.

/// A colour.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Ink {
    /// That of the text around.
    Text,
    /// The same, held back.
    Faint,
    /// What is right.
    Right,
    /// What came and is not.
    Wrong,
}

impl Ink {
    /// As an SVG paint.
    pub(super) fn paint(self) -> &'static str {
        match self {
            Ink::Text | Ink::Faint => "currentColor",
            Ink::Right => "var(--right, #0072b2)",
            Ink::Wrong => "var(--wrong, #d55e00)",
        }
    }

    /// How much of it.
    pub(super) fn opacity(self) -> &'static str {
        match self {
            Ink::Text | Ink::Right | Ink::Wrong => "1",
            Ink::Faint => "0.72",
        }
    }
}

/// A kind of line.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum LineStyle {
    /// Around shapes.
    Outline,
    /// What is there for orientation.
    Grid,
    /// A ray ahead of its origin.
    Ray,
    /// The line of a ray behind its origin.
    Behind,
    /// The part of a ray that counts.
    Range,
    /// What is right.
    Right,
    /// What came and is not.
    Wrong,
}

impl LineStyle {
    /// As attributes of an SVG element.
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

/// What fills an area.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Fill {
    /// Nothing.
    None,
    /// So much of the ink, from 0 to 1.
    Tint(Ink, f64),
}

impl Fill {
    /// As attributes of an SVG element.
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
