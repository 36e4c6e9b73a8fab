//! The values of a picture's pixels.

use glam::UVec2;
use view_probe::messages::Draw;

use super::tiles::Tiles;

/// The values of a picture.
#[derive(Clone, Debug)]
pub struct Layer<T> {
    /// The pixels that have been drawn.
    pub tiles: Tiles,
    /// For each pixel, its value or the sum of its samples, row by row from the bottom.
    values: Vec<T>,
}

impl<T: Copy + Default> Layer<T> {
    /// Creates an empty picture. `samples` is the number of samples that each pixel should get.
    pub fn new(film: UVec2, samples: u32) -> Self {
        let tiles = Tiles::new(film, samples);
        Layer {
            values: vec![T::default(); tiles.counts.len()],
            tiles,
        }
    }

    /// Adds the values of the first pixels in a request and marks the pixels where the code
    /// panicked. `panicked` contains their indices in the request. `add` computes the new value of
    /// a pixel from the old value and a sample.
    pub fn add(
        &mut self,
        index: usize,
        draw: &Draw,
        values: &[T],
        panicked: impl IntoIterator<Item = u32>,
        add: impl Fn(T, T) -> T,
    ) {
        for ((_, pixel), value) in draw.pixels().zip(values) {
            let slot = &mut self.values[self.tiles.index(pixel)];
            *slot = add(*slot, *value);
        }
        self.tiles.add(index, draw, values.len(), panicked);
    }

    /// Returns the value and the number of samples of a pixel. A pixel that hasn't been drawn yet
    /// shows the value of the nearest drawn pixel below and to the left. Returns `None` if no such
    /// pixel has been drawn.
    pub fn shown(&self, pixel: UVec2) -> Option<PixelContent<T>> {
        let counts = &self.tiles.counts;
        let coarser = [1, 2, 4].map(|stride| self.tiles.index(pixel / stride * stride));
        let drawn = coarser.into_iter().find(|index| counts[*index] > 0)?;
        Some(if self.tiles.panicked[drawn] {
            PixelContent::Panicked
        } else {
            PixelContent::Value(self.values[drawn], counts[drawn])
        })
    }

    /// Returns all values, row by row from the bottom, with `None` for pixels that haven't been
    /// drawn.
    pub fn values(&self) -> impl Iterator<Item = Option<T>> {
        let drawn = self.tiles.counts.iter().zip(&self.values);
        drawn.map(|(count, value)| (*count > 0).then_some(*value))
    }
}

/// The content of a pixel.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum PixelContent<T> {
    /// The pixel's value or the sum of its samples, followed by the number of samples.
    Value(T, u32),
    /// Drawing it caused a panic.
    Panicked,
}

#[cfg(test)]
mod tests {
    use glam::uvec2;
    use view_probe::messages::Quantity;

    use super::*;

    #[test]
    fn coarse_pixels_are_shown_until_the_fine_ones_are_drawn() {
        let mut layer: Layer<u64> = Layer::new(uvec2(9, 9), 1);
        assert_eq!(layer.shown(uvec2(5, 5)), None);
        let (index, draw) = layer.tiles.take(Quantity::Light, 1).unwrap();
        assert_eq!(draw.pixels().count(), 9);
        assert!(
            layer.tiles.take(Quantity::Light, 1).is_none(),
            "the only tile is being drawn"
        );
        layer.add(index, &draw, &[7; 9], [4], |sum, sample| sum + sample);
        assert!(layer.tiles.has_coarse_picture() && !layer.tiles.is_complete());
        assert_eq!(layer.shown(uvec2(3, 3)), Some(PixelContent::Value(7, 1)));
        // Index 4 is the pixel (4, 4).
        assert_eq!(layer.shown(uvec2(5, 6)), Some(PixelContent::Panicked));
    }
}
