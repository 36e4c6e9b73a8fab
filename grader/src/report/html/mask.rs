//! Renders the mask, which shows the error in each pixel as a colour and a pattern. The patterns
//! are for readers who cannot distinguish the colours. The colours are from Okabe and Ito, "Color
//! Universal Design", 2008.

use glam::UVec2;
use judging::judge::Aspect;
use judging::picture::{Colour, MaskPixel, Picture};

use crate::png_file::data_uri;

/// The width of a mask in screen pixels.
const WIDTH: u32 = 256;
/// The period of a pattern in screen pixels.
const PATTERN_PERIOD: u32 = 4;
/// The width of a legend patch in screen pixels.
const PATCH_WIDTH: u32 = 16;

const EMPTY: Colour = [40, 40, 44];
const RIGHT: Colour = [104, 104, 108];
const BLACK: Colour = [0, 0, 0];

/// Returns the mask as a data URI. Each pixel of the film becomes a block of screen pixels.
pub(super) fn mask(picture: &Picture) -> String {
    let block = (WIDTH / picture.film.max_element()).max(1);
    let size = picture.film * block;
    let colour = |position: UVec2| {
        let pixel = position / block;
        let mask_pixel = picture.mask[(pixel.y * picture.film.x + pixel.x) as usize];
        match mask_pixel {
            MaskPixel::Empty => EMPTY,
            MaskPixel::Right => RIGHT,
            MaskPixel::Wrong(aspect) => pattern(aspect, position),
        }
    };
    paint(size, colour)
}

/// Returns a legend patch as a data URI.
pub(super) fn patch(aspect: Aspect) -> String {
    paint(UVec2::splat(PATCH_WIDTH), |position| {
        pattern(aspect, position)
    })
}

fn paint(size: UVec2, colour: impl Fn(UVec2) -> Colour) -> String {
    let rows = (0..size.y).flat_map(|y| (0..size.x).map(move |x| UVec2::new(x, y)));
    data_uri(size, &rows.map(colour).collect::<Vec<_>>())
}

/// Returns the colour of a pattern at one screen pixel.
fn pattern(aspect: Aspect, position: UVec2) -> Colour {
    let UVec2 { x, y } = position % PATTERN_PERIOD;
    let (colour, is_on) = match aspect {
        // Vermillion, solid.
        Aspect::HitOrMiss | Aspect::Direction | Aspect::Radiance => ([213, 94, 0], true),
        // Sky blue, horizontal stripes.
        Aspect::Depth => ([86, 180, 233], y < 2),
        // Yellow, vertical stripes.
        Aspect::Normal => ([240, 228, 66], x < 2),
        // Bluish green, dots.
        Aspect::Uv => ([0, 158, 115], x < 2 && y < 2),
        // Reddish purple, crosses.
        Aspect::NoAnswer => ([204, 121, 167], x == y || x + y == PATTERN_PERIOD - 1),
    };
    if is_on { colour } else { BLACK }
}

#[cfg(test)]
mod tests {
    use std::collections::BTreeSet;

    use super::*;

    /// Compares the patterns without their colours, for aspects that can occur in the same mask.
    #[test]
    fn no_two_aspects_of_a_mask_have_the_same_pattern() {
        let aspects = [
            Aspect::NoAnswer,
            Aspect::HitOrMiss,
            Aspect::Depth,
            Aspect::Normal,
            Aspect::Uv,
        ];
        let shape = |aspect: Aspect| -> Vec<bool> {
            let positions = (0..PATTERN_PERIOD * PATTERN_PERIOD)
                .map(|i| UVec2::new(i % PATTERN_PERIOD, i / PATTERN_PERIOD));
            positions
                .map(|position| pattern(aspect, position) != BLACK)
                .collect()
        };
        let shapes: BTreeSet<_> = aspects.map(shape).into_iter().collect();
        assert_eq!(shapes.len(), aspects.len());
    }
}
