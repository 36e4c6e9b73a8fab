//! The order in which a picture's pixels are drawn: first every fourth pixel of every fourth row,
//! then every second pixel of every second row, then all pixels. After that, each pixel gets one
//! more sample at a time.
//!
//! The film is divided into tiles. Each tile is drawn by one probe at a time, one sample after the
//! other, so that samples are added in order, as in `cargo render`. Tiles never wait for each
//! other.

use glam::{UVec2, uvec2};
use view_probe::messages::{Draw, MAX_VALUES, Quantity};

/// The side of a tile in pixels: a multiple of the largest stride.
const TILE: u32 = 64;
/// The maximum number of samples in a request. One sample of a tile only takes a few milliseconds,
/// so with a single sample per request, exchanging requests would take a tenth of the total time.
const MAX_PASSES: u32 = 16;
/// The strides of the first steps.
const STRIDES: [u32; 3] = [4, 2, 1];
const _: () = assert!((TILE * TILE * MAX_PASSES) as usize <= MAX_VALUES);

/// The pixels of a picture that have been drawn, regardless of their values.
#[derive(Clone, Debug)]
pub struct Tiles {
    /// The size of the picture.
    pub film: UVec2,
    tiles: Vec<Tile>,
    /// The number of samples that each pixel should get.
    pub samples: u32,
    /// The number of samples drawn for each pixel, row by row from the bottom.
    pub(super) counts: Vec<u32>,
    /// For each pixel, whether drawing it caused a panic.
    pub(super) panicked: Vec<bool>,
}

#[derive(Clone, Debug)]
struct Tile {
    origin: UVec2,
    size: UVec2,
    /// The number of complete steps.
    step: u32,
    /// The number of samples per pixel in the current request.
    passes: u32,
    /// The number of samples in the current request that have been drawn.
    first: u32,
    is_busy: bool,
}

impl Tiles {
    pub(super) fn new(film: UVec2, samples: u32) -> Self {
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
        Tiles {
            film,
            tiles: tiles.map(tile).collect(),
            samples,
            counts: vec![0; pixels],
            panicked: vec![false; pixels],
        }
    }

    /// Takes the tile with the fewest samples among the tiles that need more and aren't being
    /// drawn. Returns its index and the request for it, or `None` if there is no such tile.
    pub fn take(&mut self, quantity: Quantity, milliseconds: u32) -> Option<(usize, Draw)> {
        let steps = self.steps();
        let samples = self.samples;
        let tiles = self.tiles.iter_mut().enumerate();
        let open = tiles.filter(|(_, tile)| !tile.is_busy && tile.step < steps);
        let (index, tile) = open.min_by_key(|(_, tile)| tile.step)?;
        tile.is_busy = true;
        Some((index, tile.draw(quantity, samples, milliseconds)))
    }

    /// Counts another sample for each of the first `drawn` pixels in a request and marks the
    /// pixels where the code panicked. `panicked` contains the indices of those pixels in the
    /// request.
    pub fn add(
        &mut self,
        index: usize,
        draw: &Draw,
        drawn: usize,
        panicked: impl IntoIterator<Item = u32>,
    ) {
        let pixels = draw.pixels().map(|(_, pixel)| self.index(pixel));
        let pixels: Vec<usize> = pixels.take(drawn).collect();
        for pixel in &pixels {
            self.counts[*pixel] += 1;
        }
        for number in panicked {
            if let Some(pixel) = pixels.get(number as usize) {
                self.panicked[*pixel] = true;
            }
        }
        let of_pass = u32::try_from(draw.pixels_of_pass().count()).unwrap_or(u32::MAX);
        let done = u32::try_from(drawn).unwrap_or(u32::MAX) + draw.first;
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

    /// Returns whether all samples of every pixel have been drawn.
    pub fn is_complete(&self) -> bool {
        let steps = self.steps();
        self.tiles.iter().all(|tile| tile.step >= steps)
    }

    /// Returns whether the coarse picture is complete.
    pub fn has_coarse_picture(&self) -> bool {
        self.tiles.iter().all(|tile| tile.step > 0)
    }

    /// Returns the smallest number of samples that any pixel has.
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

    /// Returns the index of a pixel in a list of all pixels, row by row from the bottom.
    pub fn index(&self, pixel: UVec2) -> usize {
        pixel.y as usize * self.film.x as usize + pixel.x as usize
    }
}

impl Tile {
    fn draw(&mut self, quantity: Quantity, samples: u32, milliseconds: u32) -> Draw {
        let step = self.step as usize;
        let (stride, drawn_stride, sample) = match STRIDES.get(step) {
            Some(stride) if step == 0 => (*stride, 0, 0),
            Some(stride) => (*stride, STRIDES[step - 1], 0),
            None => (1, 0, self.step + 1 - STRIDES.len() as u32),
        };
        // At first, requests ask for few samples, so that the picture changes often. Later, it may
        // change less often.
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
            quantity,
            sample,
            milliseconds,
        }
    }
}
