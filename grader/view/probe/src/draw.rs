//! Draws pixels and records single rays and paths.

use std::time::{Duration, Instant};

use framework::harness::attempt::attempt;
use framework::render::integrator::{Integrator, RenderStats};
use glam::{UVec2, Vec2};
use protocol::{Panic, Trace};

use crate::messages::{
    Draw, Drawn, Follow, Followed, MAX_PANICS, Quantity, Target, TestCounts, Values,
};
use crate::record;
use crate::stage::Stage;

/// Draws pixels until all are drawn or the time is up.
pub(crate) fn draw(stage: &Stage, integrator: &Integrator, request: &Draw) -> Drawn {
    let mut stats = RenderStats::default();
    let mut pixels = Pixels {
        request,
        panics: Vec::new(),
    };
    let values = match request.quantity {
        Quantity::Hit => Values::Hits(pixels.each(None, |_, pixel| {
            stats.rays += 1;
            stage.first_hit(pixel)
        })),
        Quantity::Light { sample } => {
            Values::Light(pixels.each(Default::default(), |pass, pixel| {
                integrator.sample_radiance(pixel, sample + pass, &mut stats)
            }))
        }
        Quantity::Tests => Values::Tests(pixels.each(TestCounts::default(), |_, pixel| {
            stats.rays += 1;
            record::take_counts();
            stage.first_hit(pixel);
            record::take_counts()
        })),
    };
    Drawn {
        values,
        panics: pixels.panics,
        rays: stats.rays,
        invalid_paths: stats.invalid_paths,
    }
}

/// The pixels of a request and the panics in them.
struct Pixels<'a> {
    request: &'a Draw,
    panics: Vec<(Panic, Vec<u32>)>,
}

impl Pixels<'_> {
    /// Computes the value of each pixel until the time is up. A pixel with a panic gets
    /// `replacement`.
    fn each<T: Clone>(&mut self, replacement: T, mut value: impl FnMut(u32, UVec2) -> T) -> Vec<T> {
        let deadline = Instant::now() + Duration::from_millis(self.request.milliseconds.into());
        let mut values = Vec::new();
        let mut clock = Clock {
            deadline,
            left: 1,
            interval: 1,
            read_at: Instant::now(),
        };
        for (index, (pass, pixel)) in (0..).zip(self.request.pixels()) {
            values.push(attempt(|| value(pass, pixel)).unwrap_or_else(|panic| {
                self.add_panic(panic, index);
                replacement.clone()
            }));
            if clock.is_over() {
                break;
            }
        }
        values
    }

    /// Adds a panic to the list. The message of a panic at one location can differ from pixel to
    /// pixel, so only the first one is kept. If there are too many locations, the rest are counted
    /// as the last one.
    fn add_panic(&mut self, panic: Panic, index: u32) {
        let same = |(known, _): &(Panic, Vec<u32>)| known.location == panic.location;
        let known = self.panics.iter().position(same);
        match known.or((self.panics.len() == MAX_PANICS).then_some(MAX_PANICS - 1)) {
            Some(known) => self.panics[known].1.push(index),
            None => self.panics.push((panic, vec![index])),
        }
    }
}

/// A deadline. Reading the time takes a tenth as long as a short path, so the clock is read less
/// often while pixels are fast.
struct Clock {
    deadline: Instant,
    /// The number of pixels until the clock is read again.
    left: u32,
    interval: u32,
    read_at: Instant,
}

impl Clock {
    /// The time between two readings above which the clock is read after each pixel.
    const SLOW: Duration = Duration::from_millis(1);
    /// The maximum number of pixels between two clock readings.
    const MAX_INTERVAL: u32 = 64;

    /// Returns whether the time is up after one more pixel.
    fn is_over(&mut self) -> bool {
        self.left -= 1;
        if self.left > 0 {
            return false;
        }
        let now = Instant::now();
        self.interval = if now.saturating_duration_since(self.read_at) < Self::SLOW {
            (2 * self.interval).min(Self::MAX_INTERVAL)
        } else {
            1
        };
        self.left = self.interval;
        self.read_at = now;
        now >= self.deadline
    }
}

impl Stage<'_> {
    /// Returns the hit of the ray through the centre of a pixel, like the framework's pictures of
    /// first hits.
    fn first_hit(&self, pixel: UVec2) -> Option<Trace> {
        let ray = self.world.camera.ray(pixel, Vec2::splat(0.5));
        self.world
            .bvh
            .closest_hit(&self.scene.camera.placement.to_world(&ray))
    }
}

/// Records a ray or a path.
pub(crate) fn follow(stage: &Stage, integrator: &Integrator, request: &Follow) -> Followed {
    let mut stats = RenderStats::default();
    record::start(request);
    let outcome = attempt(|| match request.target {
        Target::Centre(pixel) => {
            stage.first_hit(pixel);
            None
        }
        Target::Path { pixel, sample } => {
            Some(integrator.sample_radiance(pixel, sample, &mut stats))
        }
        Target::Ray(ray) => {
            stage.world.bvh.closest_hit(&ray);
            None
        }
    });
    let rays = record::finish();
    let (radiance, panic) = match outcome {
        Ok(radiance) => (radiance, None),
        Err(panic) => (None, Some(panic)),
    };
    Followed {
        rays,
        radiance,
        panic,
    }
}
