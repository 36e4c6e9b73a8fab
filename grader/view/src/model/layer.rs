//! The values of a picture's pixels, and the order in which they are drawn: first every fourth pixel
//! of every fourth row, then every second, then all, then one more sample for each.
//!
//! The film is divided into tiles. A tile is drawn by one probe at a time, and its samples one after
//! the other, so that they are added in order, as in `cargo render`. No tile waits for another.

use glam::{UVec2, uvec2};
use view_probe::messages::{Draw, MAX_VALUES, Quantity};

/// The side of a tile in pixels: a multiple of the largest stride.
const TILE: u32 = 64;
/// The maximum number of samples of a request. One sample of a tile takes only a few milliseconds, so
/// that exchanging requests would take a tenth of the time.
const MAX_PASSES: u32 = 16;
/// The strides of the first steps.
const STRIDES: [u32; 3] = [4, 2, 1];
const _: () = assert!((TILE * TILE * MAX_PASSES) as usize <= MAX_VALUES);

/// The values of a picture.
#[derive(Clone, Debug)]
pub struct Layer<T> {
    film: UVec2,
    tiles: Vec<Tile>,
    /// The number of samples that each pixel should get.
    samples: u32,
    /// The sum of each pixel's samples, or its value; row by row from the bottom.
    values: Vec<T>,
    /// The number of samples of each pixel.
    counts: Vec<u32>,
    /// Whether drawing a pixel has caused a panic.
    panicked: Vec<bool>,
}

#[derive(Clone, Debug)]
struct Tile {
    origin: UVec2,
    size: UVec2,
    /// The number of steps that are complete.
    step: u32,
    /// The number of samples of each pixel in the current request.
    passes: u32,
    /// The number of samples of this request that have been drawn.
    first: u32,
    is_busy: bool,
}

impl<T: Copy + Default> Layer<T> {
    /// Creates an empty picture, of which each pixel should get this many samples.
    pub fn new(film: UVec2, samples: u32) -> Self {
        let starts = |length: u32| (0..length).step_by(TILE as usize);
        let tiles = starts(film.y).flat_map(|y| starts(film.x).map(move |x| uvec2(x, y)));
        let tile = |origin: UVec2| Tile {
            origin,
            size: (film - origin).min(UVec2::splat(TILE)),
            step: 0,
            passes: 1,
            first: 0,
            is_busy: false,
        };
        let pixels = film.x as usize * film.y as usize;
        Layer {
            film,
            tiles: tiles.map(tile).collect(),
            samples,
            values: vec![T::default(); pixels],
            counts: vec![0; pixels],
            panicked: vec![false; pixels],
        }
    }

    /// Changes the number of samples that each pixel should get.
    pub fn set_samples(&mut self, samples: u32) {
        self.samples = samples;
    }

    /// Returns the number of samples that each pixel should get.
    pub fn samples(&self) -> u32 {
        self.samples
    }

    /// Takes the tile with the fewest samples, if one needs more and is not being drawn. Returns its
    /// index and the request for it.
    pub fn take(
        &mut self,
        quantity: fn(u32) -> Quantity,
        milliseconds: u32,
    ) -> Option<(usize, Draw)> {
        let steps = self.steps();
        let samples = self.samples;
        let tiles = self.tiles.iter_mut().enumerate();
        let open = tiles.filter(|(_, tile)| !tile.is_busy && tile.step < steps);
        let (index, tile) = open.min_by_key(|(_, tile)| tile.step)?;
        tile.is_busy = true;
        Some((index, tile.draw(quantity, samples, milliseconds)))
    }

    /// Adds the values of the first pixels of a request, and marks the pixels with a panic, by their
    /// indices in the request.
    pub fn add(
        &mut self,
        index: usize,
        draw: &Draw,
        values: &[T],
        panicked: impl IntoIterator<Item = u32>,
        add: impl Fn(&mut T, T),
    ) {
        let pixels: Vec<usize> = draw.pixels().map(|(_, pixel)| self.index(pixel)).collect();
        for (pixel, value) in pixels.iter().zip(values) {
            add(&mut self.values[*pixel], *value);
            self.counts[*pixel] += 1;
        }
        for number in panicked {
            if let Some(pixel) = pixels.get(number as usize) {
                self.panicked[*pixel] = true;
            }
        }
        let of_pass = u32::try_from(draw.pixels_of_pass().count()).unwrap_or(u32::MAX);
        let done = u32::try_from(values.len()).unwrap_or(u32::MAX) + draw.first;
        let tile = &mut self.tiles[index];
        tile.is_busy = false;
        if done >= of_pass * draw.passes {
            tile.step += draw.passes;
            tile.first = 0;
        } else {
            tile.first = done;
        }
    }

    fn steps(&self) -> u32 {
        (STRIDES.len() as u32 - 1).saturating_add(self.samples)
    }

    /// Returns whether every pixel has all of its samples.
    pub fn is_complete(&self) -> bool {
        let steps = self.steps();
        self.tiles.iter().all(|tile| tile.step >= steps)
    }

    /// Returns whether the coarse picture is complete.
    pub fn has_coarse_picture(&self) -> bool {
        self.tiles.iter().all(|tile| tile.step > 0)
    }

    /// Returns the number of samples that every pixel has at least.
    pub fn complete_samples(&self) -> u32 {
        let first_of_all = STRIDES.len() as u32 - 1;
        let steps = self.tiles.iter().map(|tile| tile.step);
        steps.min().unwrap_or(0).saturating_sub(first_of_all)
    }

    /// Returns the share of all samples that have been drawn.
    pub fn progress(&self) -> f64 {
        let drawn: u64 = self.counts.iter().map(|count| u64::from(*count)).sum();
        let all = self.counts.len() as f64 * f64::from(self.samples.max(1));
        drawn as f64 / all.max(1.0)
    }

    /// Returns the value and the number of samples of a pixel. A pixel that is not drawn yet shows
    /// the nearest one below and to the left that is. Returns `None` if there is none.
    pub fn shown(&self, pixel: UVec2) -> Option<Shown<T>> {
        let coarser = [1, 2, 4].map(|stride| self.index(pixel / stride * stride));
        let drawn = coarser.into_iter().find(|index| self.counts[*index] > 0)?;
        Some(if self.panicked[drawn] {
            Shown::Panicked
        } else {
            Shown::Value(self.values[drawn], self.counts[drawn])
        })
    }

    /// Returns the size of the picture.
    pub fn film(&self) -> UVec2 {
        self.film
    }

    /// Returns all values, row by row from the bottom, with `None` for pixels that are not drawn.
    pub fn values(&self) -> impl Iterator<Item = Option<T>> {
        let drawn = self.counts.iter().zip(&self.values);
        drawn.map(|(count, value)| (*count > 0).then_some(*value))
    }

    fn index(&self, pixel: UVec2) -> usize {
        pixel.y as usize * self.film.x as usize + pixel.x as usize
    }
}

/// The content of a pixel.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Shown<T> {
    /// The sum of its samples, or its value, and the number of samples.
    Value(T, u32),
    /// Drawing it has caused a panic.
    Panicked,
}

impl Tile {
    fn draw(&mut self, quantity: fn(u32) -> Quantity, samples: u32, milliseconds: u32) -> Draw {
        let step = self.step as usize;
        let (stride, drawn_stride, sample) = match STRIDES.get(step) {
            Some(stride) if step == 0 => (*stride, 0, 0),
            Some(stride) => (*stride, STRIDES[step - 1], 0),
            None => (1, 0, self.step + 1 - STRIDES.len() as u32),
        };
        // At first every picture shows more; later it may show less often.
        if self.first == 0 {
            let rest = samples.saturating_sub(sample);
            self.passes = rest.clamp(1, sample.clamp(1, MAX_PASSES));
        }
        Draw {
            origin: self.origin,
            size: self.size,
            stride,
            drawn_stride,
            passes: self.passes,
            first: self.first,
            quantity: quantity(sample),
            milliseconds,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn light(sample: u32) -> Quantity {
        Quantity::Light { sample }
    }

    /// Draws a picture whose pixels list the numbers of their samples as digits, and lets each
    /// request draw at most `most` pixels.
    fn draw_all(film: UVec2, samples: u32, most: usize) -> Layer<u64> {
        let mut layer = Layer::new(film, samples);
        while let Some((index, draw)) = layer.take(light, 1) {
            let Quantity::Light { sample } = draw.quantity else {
                unreachable!("only light is drawn")
            };
            let numbers = draw.pixels().take(most).map(|(pass, _)| sample + pass + 1);
            let values: Vec<u64> = numbers.map(u64::from).collect();
            layer.add(index, &draw, &values, [], |sum, sample| {
                *sum = 10 * *sum + sample
            });
        }
        layer
    }

    #[test]
    fn each_pixel_gets_its_samples_in_order_whatever_a_request_draws() {
        for film in [uvec2(1, 1), uvec2(65, 3), uvec2(130, 70)] {
            for most in [1, 7, usize::MAX] {
                let layer = draw_all(film, 9, most);
                assert!(layer.is_complete() && layer.complete_samples() == 9);
                assert!(
                    layer.values().all(|value| value == Some(123_456_789)),
                    "{film} {most}"
                );
            }
        }
    }

    #[test]
    fn coarse_pixels_are_shown_until_the_fine_ones_are_drawn() {
        let mut layer: Layer<u64> = Layer::new(uvec2(9, 9), 1);
        assert_eq!(layer.shown(uvec2(5, 5)), None);
        let (index, draw) = layer.take(light, 1).unwrap();
        assert_eq!(draw.pixels().count(), 9);
        assert!(
            layer.take(light, 1).is_none(),
            "the only tile is being drawn"
        );
        layer.add(index, &draw, &[7; 9], [4], |sum, sample| *sum += sample);
        assert!(layer.has_coarse_picture() && !layer.is_complete());
        assert_eq!(layer.shown(uvec2(3, 3)), Some(Shown::Value(7, 1)));
        // Number 4 is the pixel (4, 4).
        assert_eq!(layer.shown(uvec2(5, 6)), Some(Shown::Panicked));
    }

    #[test]
    fn more_samples_continue_a_complete_picture() {
        let mut layer = draw_all(uvec2(3, 3), 1, 99);
        layer.set_samples(2);
        assert!(!layer.is_complete());
        let (_, draw) = layer.take(light, 1).unwrap();
        assert_eq!((draw.quantity, draw.pixels().count()), (light(1), 9));
    }
}
