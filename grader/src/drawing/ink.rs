//! Colours and line styles. Colour is never the only difference: the expected answer is drawn with
//! solid lines and discs, and the submitted answer with dashed lines and crosses.
//!
//! A page may set the custom properties `--right`, `--wrong` and `--paper`, e.g. for a dark theme.
//! The default colours are from Okabe and Ito, "Color Universal Design", 2008.

/// A colour for lines, areas and text in a drawing.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Ink {
    /// The text colour of the page.
    Text,
    /// A lighter shade of the text colour.
    Faint,
    /// The colour of the expected answer.
    Right,
    /// The colour of the submitted answer, if that answer is wrong.
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

    /// Returns the opacity, as an SVG value, or `None` if it is 1.
    pub(super) fn opacity(self) -> Option<&'static str> {
        match self {
            Ink::Text | Ink::Right | Ink::Wrong => None,
            Ink::Faint => Some("0.72"),
        }
    }
}

/// The style of a line, which depends on the line's meaning.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum LineStyle {
    /// The outline of a shape.
    Outline,
    /// A guide line.
    Grid,
    /// The part of a ray's line ahead of its origin.
    Ray,
    /// The part of a ray's line behind its origin.
    Behind,
    /// The range of a ray.
    Range,
    /// A line that shows the expected answer.
    Right,
    /// A line that shows the submitted answer, if that answer is wrong.
    Wrong,
}

/// The attributes of a line, as SVG values.
#[derive(Clone, Copy, Debug)]
pub(super) struct Stroke {
    /// The colour.
    pub(super) paint: &'static str,
    /// The opacity, or `None` if it is 1.
    pub(super) opacity: Option<&'static str>,
    /// The width.
    pub(super) width: &'static str,
    /// The lengths of dashes and gaps, or `None` for a solid line.
    pub(super) dashes: Option<&'static str>,
}

impl LineStyle {
    /// Returns the attributes for this line style.
    pub(super) fn stroke(self) -> Stroke {
        let (ink, opacity, width, dashes) = match self {
            LineStyle::Outline => (Ink::Text, None, "1.5", None),
            LineStyle::Grid => (Ink::Text, Some("0.3"), "1", None),
            LineStyle::Ray => (Ink::Text, Some("0.85"), "1.5", None),
            LineStyle::Behind => (Ink::Text, Some("0.6"), "1.2", Some("1.5 4")),
            LineStyle::Range => (Ink::Text, Some("0.35"), "7", None),
            LineStyle::Right => (Ink::Right, None, "2.5", None),
            LineStyle::Wrong => (Ink::Wrong, None, "2.5", Some("6 4")),
        };
        Stroke {
            paint: ink.paint(),
            opacity,
            width,
            dashes,
        }
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
    /// Returns the SVG paint.
    pub(super) fn paint(self) -> &'static str {
        match self {
            Fill::None => "none",
            Fill::Tint(ink, _) => ink.paint(),
        }
    }

    /// Returns the opacity, as an SVG value, or `None` if there is no fill.
    pub(super) fn opacity(self) -> Option<String> {
        match self {
            Fill::None => None,
            Fill::Tint(_, share) => Some(format!("{:.2}", share.clamp(0.0, 1.0))),
        }
    }
}
