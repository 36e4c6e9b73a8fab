//! Draws pixels and records single rays and paths.

use std::cell::OnceCell;
use std::time::{Duration, Instant};

use framework::harness::attempt::attempt;
use framework::harness::lighting::written_path_tracer;
use framework::render::clay::Clay;
use framework::render::path_log;
use framework::render::path_steps::{FirstBadValues, Step, bounces};
use framework::render::renderer::{Lighting, RenderStats, Renderer};
use glam::{UVec2, Vec2, Vec3};
use protocol::{Panic, Trace};

use crate::messages::{
    Draw, DrawnPixels, Follow, MAX_PANICS, MAX_STEP_BYTES, MarkedTests, PathSample, Quantity,
    RecordedRays, Target, Values,
};
use crate::open_scene::OpenScene;
use crate::record;
use crate::rules::{RULES, count_marks};

/// The maximum number of tests to judge for a pixel. A traversal that performs more tests than this
/// has already broken the rules, and judging all of its tests would take much longer than
/// performing them.
const MAX_JUDGED: u32 = 500;

/// The renderers of a scene.
pub(crate) struct Renderers<'a> {
    stage: &'a OpenScene<'a>,
    lighting: &'a dyn Lighting,
    /// The path tracer, or why there is none. It is only created for the shaded view, so
    /// that no other view needs part two.
    path_tracer: OnceCell<Result<Box<dyn Renderer + 'a>, Panic>>,
    clay: Clay<'a>,
}

impl<'a> Renderers<'a> {
    pub(crate) fn new(stage: &'a OpenScene, lighting: &'a dyn Lighting, clay: Clay<'a>) -> Self {
        Renderers {
            stage,
            lighting,
            path_tracer: OnceCell::new(),
            clay,
        }
    }

    /// Returns the renderer of the shaded view, which is clay if part two isn't written yet.
    fn light(&self) -> &dyn Renderer {
        let path_tracer = self.path_tracer.get_or_init(|| {
            let OpenScene {
                scene, world, aim, ..
            } = self.stage;
            written_path_tracer(self.lighting, scene, world, aim.settings)
        });
        match path_tracer {
            Ok(path_tracer) => &**path_tracer,
            Err(_) => &self.clay,
        }
    }

    /// Returns the renderer of a quantity, or `None` if the quantity comes from a single ray.
    fn of(&self, quantity: Quantity) -> Option<&dyn Renderer> {
        match quantity {
            Quantity::Light => Some(self.light()),
            Quantity::Clay => Some(&self.clay),
            Quantity::Hit | Quantity::Tests => None,
        }
    }

    /// Returns why there is no path tracer, if one was needed.
    fn no_light(&self) -> Option<Panic> {
        self.path_tracer.get()?.as_ref().err().cloned()
    }
}

/// Draws pixels until all are drawn or the time is up.
pub(crate) fn draw(stage: &OpenScene, renderers: &Renderers, request: &Draw) -> DrawnPixels {
    let mut stats = RenderStats::default();
    let mut pixels = Pixels {
        request,
        panics: Vec::new(),
    };
    let values = match renderers.of(request.quantity) {
        Some(renderer) => Values::Light(pixels.each(Vec3::ZERO, |pass, pixel| {
            renderer.sample_radiance(pixel, request.sample + pass, &mut stats)
        })),
        None if request.quantity == Quantity::Hit => Values::Hits(pixels.each(None, |_, pixel| {
            stats.rays += 1;
            stage.first_hit(pixel)
        })),
        None => Values::Tests(pixels.each(MarkedTests::default(), |_, pixel| {
            stats.rays += 1;
            stage.marked_tests(pixel)
        })),
    };
    // A panic leaves the list of recorded rays behind.
    record::finish();
    DrawnPixels {
        values,
        panics: pixels.panics,
        stats,
        no_light: renderers.no_light(),
    }
}

/// The pixels of a request, and the panics that occurred while drawing them.
struct Pixels<'a> {
    request: &'a Draw,
    panics: Vec<(Panic, Vec<u32>)>,
}

impl Pixels<'_> {
    /// Computes the value of each pixel until the time is up. If the code panics for a pixel, the
    /// pixel's value is `replacement`.
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

    /// Adds a panic to the list. The messages of panics at the same location can differ from pixel
    /// to pixel, so only the first message is kept. Once the list is full, panics at other
    /// locations are counted under the last location in the list.
    fn add_panic(&mut self, panic: Panic, index: u32) {
        let same = |(known, _): &(Panic, Vec<u32>)| known.location == panic.location;
        let known = self.panics.iter().position(same);
        match known.or((self.panics.len() == MAX_PANICS).then_some(MAX_PANICS - 1)) {
            Some(known) => self.panics[known].1.push(index),
            None => self.panics.push((panic, vec![index])),
        }
    }
}

/// A deadline. Reading the time takes a tenth as long as tracing a short path, so the clock is read
/// less often while pixels are drawn quickly.
struct Clock {
    deadline: Instant,
    /// The number of pixels until the clock is read again.
    left: u32,
    interval: u32,
    read_at: Instant,
}

impl Clock {
    /// If more time than this passes between two readings, the clock is read after each pixel.
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

impl OpenScene<'_> {
    /// Returns the closest hit of the ray through the centre of a pixel, which is the same hit as
    /// in the framework's pictures of first hits.
    fn first_hit(&self, pixel: UVec2) -> Option<Trace> {
        let ray = self.world.camera.ray(pixel, Vec2::splat(0.5));
        self.world
            .bvh
            .closest_hit(&self.scene.camera.placement.to_world(&ray))
    }

    /// Returns the tests performed for the ray through the centre of a pixel.
    fn marked_tests(&self, pixel: UVec2) -> MarkedTests {
        let tree = self.indexed_tree();
        record::start(MAX_JUDGED, 1);
        self.first_hit(pixel);
        let rays = record::finish();
        let Some(ray) = rays.first() else {
            return MarkedTests::default();
        };
        // Without a tree, there are no steps to judge.
        let is_judged = tree.has_nodes() && ray.counts.boxes > 0;
        let span = |corners| self.intersect_box(corners, &ray.ray);
        MarkedTests {
            counts: ray.counts,
            marks: if is_judged {
                count_marks(ray, tree, span)
            } else {
                [0; RULES]
            },
        }
    }
}

/// Records a ray or a path.
pub(crate) fn follow(stage: &OpenScene, renderers: &Renderers, request: &Follow) -> RecordedRays {
    let mut stats = RenderStats::default();
    record::start(request.max_tests, request.max_rays);
    let renderer = match request.target {
        Target::Pixel { quantity, .. } => renderers.of(quantity),
        Target::Ray(_) => None,
    };
    // Creating the path tracer traces a path. Only the rays of the requested path are recorded.
    record::start(request.max_tests, request.max_rays);
    let trace = || match (request.target, renderer) {
        (Target::Pixel { pixel, sample, .. }, Some(renderer)) => {
            Some(renderer.sample_radiance(pixel, sample, &mut stats))
        }
        (Target::Pixel { pixel, .. }, None) => {
            stage.first_hit(pixel);
            None
        }
        (Target::Ray(ray), _) => {
            stage.world.bvh.closest_hit(&ray);
            None
        }
    };
    let (outcome, steps) = path_log::follow(|| attempt(trace));
    let shown = |step: &Step| {
        let mut text = step.to_string();
        text.truncate(text.floor_char_boundary(MAX_STEP_BYTES));
        text
    };
    let rays = record::finish();
    let (radiance, panic) = match outcome {
        Ok(radiance) => (radiance, None),
        Err(panic) => (None, Some(panic)),
    };
    RecordedRays {
        rays,
        radiance,
        bounces: bounces(&steps),
        steps: steps.iter().map(shown).collect(),
        panic,
    }
}

/// Computes the first samples of a pixel, one by one. Returns none if part two isn't written yet.
pub(crate) fn samples(renderers: &Renderers, pixel: UVec2, count: u32) -> Vec<PathSample> {
    let renderer = renderers.light();
    if renderers.no_light().is_some() {
        return Vec::new();
    }
    let sample = |sample| {
        let mut stats = RenderStats::default();
        let trace = || renderer.trace_sample(pixel, sample, &mut stats);
        let (outcome, steps) = path_log::follow(|| attempt(trace));
        let mut bad_values = FirstBadValues::default();
        bad_values.add_path(pixel, &steps);
        PathSample {
            outcome,
            bad_values,
        }
    };
    (0..count).map(sample).collect()
}
