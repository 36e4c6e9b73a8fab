//! The limits on responses. They are derived from the request, so a submission's program cannot
//! make the viewer read, keep or show more than the scene needs.

use std::fmt;
use std::marker::PhantomData;

use framework::render::path_log::MAX_STEPS;
use framework::render::path_steps::BadValue;
use protocol::{ElementOutcome, Panic};
use serde::de::{Deserialize, Deserializer, Error, SeqAccess, Visitor};

use super::{DrawnPixels, Quantity, Request, Response, TreeData, Values};

/// The maximum number of values in a response: 16 samples of 64 × 64 pixels.
pub const MAX_VALUES: usize = 1 << 16;
/// The maximum number of panics in a response.
pub const MAX_PANICS: usize = 64;
/// The maximum number of rays in a recording. It is more than twice the maximum number of bounces.
pub(super) const MAX_RAYS: usize = 1 << 15;

/// The maximum number of bytes in a step of a path. Longer steps are cut off.
pub(crate) const MAX_STEP_BYTES: usize = 256;
/// The maximum number of samples in a response.
pub const MAX_SAMPLES: usize = 64;

/// The maximum sizes on the wire, in bytes. A 32-bit integer takes up to 5 bytes, and a float takes
/// 4.
const PANIC_BYTES: usize = 2 * (Panic::MAX_TEXT_BYTES + 2);
const TRACE_BYTES: usize = 12 * 4 + 5;
const NODE_BYTES: usize = 6 * 4 + 4 * 5;
const RAY_BYTES: usize = 8 * 4 + 1 + TRACE_BYTES + 3 * 5;
const TEST_BYTES: usize = 1 + 9 * 4 + 10;
const SPAN_BYTES: usize = 1 + 2 * 4;
/// The bytes of a bounce, apart from the arriving light. The name of the surface is short.
const BOUNCE_BYTES: usize = 4 * 5 + 9 * 4 + 64 + BadValue::COUNT;
const ARRIVING_LIGHT_BYTES: usize = 4 * 4 + 1;
const BAD_VALUES_BYTES: usize = BadValue::COUNT * (1 + 4 * 5);
const SAMPLE_BYTES: usize = 5 + PANIC_BYTES + BAD_VALUES_BYTES;

impl Request {
    /// Returns the maximum size of the response on the wire, in bytes.
    pub fn max_response_bytes(&self) -> usize {
        let of_lists = match self {
            Request::Scene(_) | Request::Try { .. } | Request::Build | Request::Aim(_) => 0,
            // Each pixel has a value and can be listed under a panic.
            Request::Draw(draw) => draw.pixels().count() * (1 + TRACE_BYTES + 5),
            Request::Tree(size) => size.nodes as usize * NODE_BYTES + size.primitives as usize * 4,
            Request::Follow(follow) => {
                // Each step can be a bounce or belong to arriving light.
                let of_step = MAX_STEP_BYTES + 2 + BOUNCE_BYTES.max(ARRIVING_LIGHT_BYTES);
                let steps = MAX_STEPS * of_step;
                MAX_RAYS * RAY_BYTES + follow.max_tests as usize * TEST_BYTES + steps
            }
            Request::Samples { count, .. } => *count as usize * SAMPLE_BYTES,
            Request::Boxes { boxes, .. } => boxes.len() * SPAN_BYTES,
        };
        // The lists of all panics, plus a few numbers.
        of_lists + BAD_VALUES_BYTES + (MAX_PANICS + 1) * (PANIC_BYTES + 5) + 64
    }
}

impl Response {
    /// Returns whether this response answers the request and contains the requested number of
    /// values.
    pub fn answers(&self, request: &Request) -> bool {
        let is_whole = match (request, self) {
            (Request::Scene(_), Response::Received)
            | (Request::Try { .. }, Response::Tried)
            | (Request::Build, Response::Opened(_))
            | (Request::Aim(_), Response::Aimed)
            | (_, Response::NotOpen) => true,
            (Request::Draw(draw), Response::Drawn(drawn)) => {
                let of_quantity = matches!(
                    (draw.quantity, &drawn.values),
                    (Quantity::Hit, Values::Hits(_))
                        | (Quantity::Light | Quantity::Clay, Values::Light(_))
                        | (Quantity::Tests, Values::Tests(_))
                );
                // If a response contained no pixels, the same pixels would be requested again
                // forever.
                let is_some = (1..=draw.pixels().count()).contains(&drawn.values.count());
                of_quantity && is_some && has_possible_numbers(drawn)
            }
            (Request::Tree(size), Response::Tree(outcome)) => match outcome {
                ElementOutcome::Value(TreeData(tree)) => {
                    (tree.nodes.len(), tree.order.len())
                        == (size.nodes as usize, size.primitives as usize)
                }
                ElementOutcome::Panicked(_) | ElementOutcome::Skipped => true,
            },
            (Request::Follow(follow), Response::Followed(followed)) => {
                let tests = followed.rays.iter().map(|ray| ray.tests.len());
                tests.sum::<usize>() <= follow.max_tests as usize
            }
            (Request::Samples { count, .. }, Response::Samples(samples)) => {
                samples.is_empty() || samples.len() == *count as usize
            }
            (Request::Boxes { boxes, .. }, Response::Spans(spans)) => spans.len() == boxes.len(),
            _ => false,
        };
        let is_short = |text: &str| text.len() <= Panic::MAX_TEXT_BYTES;
        let mut panics = self.panics().into_iter();
        is_whole && panics.all(|panic| is_short(&panic.message) && is_short(&panic.location))
    }

    fn panics(&self) -> Vec<&Panic> {
        match self {
            Response::Opened(opened) => {
                let missing = opened.missing.iter().map(|(_, panic)| panic);
                missing.chain(of_outcome(&opened.tree)).collect()
            }
            Response::Drawn(drawn) => {
                let panics = drawn.panics.iter().map(|(panic, _)| panic);
                panics.chain(&drawn.no_light).collect()
            }
            Response::Tree(tree) => of_outcome(tree).into_iter().collect(),
            Response::Followed(followed) => followed.panic.iter().collect(),
            Response::Samples(samples) => {
                let outcomes = samples.iter().map(|sample| &sample.outcome);
                outcomes
                    .filter_map(|outcome| outcome.as_ref().err())
                    .collect()
            }
            Response::Received
            | Response::Tried
            | Response::Aimed
            | Response::Spans(_)
            | Response::NotOpen => Vec::new(),
        }
    }
}

fn of_outcome<T>(outcome: &ElementOutcome<T>) -> Option<&Panic> {
    match outcome {
        ElementOutcome::Panicked(panic) => Some(panic),
        ElementOutcome::Value(_) | ElementOutcome::Skipped => None,
    }
}

/// Returns whether every panic belongs to a drawn pixel and the counts are small enough to be added
/// up without overflow.
fn has_possible_numbers(drawn: &DrawnPixels) -> bool {
    let mut indices = drawn.panics.iter().flat_map(|(_, indices)| indices);
    let count = drawn.values.count();
    let stats = &drawn.stats;
    indices.all(|index| (*index as usize) < count)
        && [stats.rays, stats.invalid_paths, stats.invalid_radiances]
            .iter()
            .all(|count| *count <= u32::MAX.into())
}

/// Deserialises a list of at most `N` elements. A value can take a single byte on the wire and 56
/// in memory, so a limit in bytes isn't enough.
pub(super) fn at_most<'de, T, D, const N: usize>(from: D) -> Result<Vec<T>, D::Error>
where
    T: Deserialize<'de>,
    D: Deserializer<'de>,
{
    struct List<T, const N: usize>(PhantomData<T>);

    impl<'de, T: Deserialize<'de>, const N: usize> Visitor<'de> for List<T, N> {
        type Value = Vec<T>;

        fn expecting(&self, f: &mut fmt::Formatter) -> fmt::Result {
            write!(f, "a list of at most {N} elements")
        }

        fn visit_seq<A: SeqAccess<'de>>(self, mut elements: A) -> Result<Vec<T>, A::Error> {
            let mut list = Vec::new();
            while let Some(element) = elements.next_element()? {
                if list.len() == N {
                    return Err(A::Error::custom("a list is too long"));
                }
                list.push(element);
            }
            Ok(list)
        }
    }

    from.deserialize_seq(List::<T, N>(PhantomData))
}

/// Encodes each number in four bytes, as in memory.
pub(super) mod fixed_width {
    use serde::{Deserialize, Deserializer, Serializer};

    pub(crate) fn serialize<S: Serializer>(list: &[u32], out: S) -> Result<S::Ok, S::Error> {
        out.collect_seq(list.iter().map(|number| number.to_le_bytes()))
    }

    pub(crate) fn deserialize<'de, D: Deserializer<'de>>(from: D) -> Result<Vec<u32>, D::Error> {
        let list = Vec::<[u8; 4]>::deserialize(from)?;
        Ok(list.into_iter().map(u32::from_le_bytes).collect())
    }
}
