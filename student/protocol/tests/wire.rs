//! Property tests of the wire format: every value round-trips, and malformed input is rejected
//! without a large allocation.

use glam::{UVec2, Vec2, Vec3};
use proptest::prelude::*;
use protocol::wire::{self, WireError};
use protocol::{
    Answer, ElementOutcome, Geometry, Interval, Panic, PinholeCamera, Question, Ray, Sample, Shape,
    Table, Trace, Tree, TreeNode,
};

fn vec3() -> impl Strategy<Value = Vec3> {
    prop::array::uniform3(any::<f32>()).prop_map(Vec3::from_array)
}

fn vec2() -> impl Strategy<Value = Vec2> {
    prop::array::uniform2(any::<f32>()).prop_map(Vec2::from_array)
}

fn interval() -> impl Strategy<Value = Interval> {
    any::<(f32, f32)>().prop_map(|(min, max)| Interval { min, max })
}

fn ray() -> impl Strategy<Value = Ray> {
    (vec3(), vec3(), interval()).prop_map(|(origin, dir, range)| Ray { origin, dir, range })
}

fn trace() -> impl Strategy<Value = Trace> {
    (any::<f32>(), vec3(), vec3(), vec2(), vec3(), any::<u32>()).prop_map(
        |(distance, position, normal, uv, origin, shape)| Trace {
            distance,
            position,
            normal,
            uv,
            origin,
            shape,
        },
    )
}

fn node() -> impl Strategy<Value = TreeNode> {
    (vec3(), vec3(), any::<[u32; 4]>()).prop_map(|(min, max, [start, size, l, r])| TreeNode {
        min,
        max,
        start,
        size,
        l,
        r,
    })
}

fn shape() -> impl Strategy<Value = Shape> {
    let sphere =
        (vec3(), any::<f32>(), any::<u32>()).prop_map(|(center, radius, shape)| Shape::Sphere {
            center,
            radius,
            shape,
        });
    let flat_triangle = (prop::array::uniform3(vec3()), any::<u32>())
        .prop_map(|(corners, shape)| Shape::FlatTriangle { corners, shape });
    prop_oneof![sphere, flat_triangle]
}

fn question() -> impl Strategy<Value = Question> {
    let sample = (any::<[u32; 2]>(), vec2()).prop_map(|(pixel, offset)| Sample {
        pixel: UVec2::from_array(pixel),
        offset,
    });
    let camera = (
        any::<(f32, f32)>(),
        any::<[u32; 2]>(),
        prop::collection::vec(sample, 0..9),
    )
        .prop_map(|((vertical_fov, aspect_ratio), film, samples)| {
            let camera = PinholeCamera {
                vertical_fov,
                aspect_ratio,
                film: UVec2::from_array(film),
            };
            Question::SampleRay(Table::of_list(camera, samples))
        });
    let hits = (
        prop::collection::vec(shape(), 0..9),
        prop::collection::vec(ray(), 0..9),
    )
        .prop_map(|(shapes, rays)| Question::hits(Geometry::List { shapes }, rays));
    prop_oneof![camera, hits]
}

fn answer() -> impl Strategy<Value = Answer> {
    let panic = (".{0,30}", ".{0,30}").prop_map(|(message, location)| Panic { message, location });
    let outcome = prop_oneof![
        prop::option::of(trace()).prop_map(ElementOutcome::Value),
        panic.prop_map(ElementOutcome::Panicked),
        Just(ElementOutcome::Skipped),
    ];
    let tree = (
        prop::collection::vec(node(), 0..9),
        any::<u32>(),
        any::<Vec<u32>>(),
    )
        .prop_map(|(nodes, root, order)| Tree { nodes, root, order });
    prop_oneof![
        prop::collection::vec(outcome, 0..9).prop_map(Answer::Hits),
        tree.prop_map(|tree| Answer::Tree(ElementOutcome::Value(tree))),
    ]
}

/// Encodes a value. The tests compare bytes rather than values, because NaN isn't equal to itself.
fn bytes<T: serde::Serialize>(value: &T) -> Vec<u8> {
    wire::encode(0, value).expect("every value can be encoded")
}

proptest! {
    #[test]
    fn questions_round_trip(question in question(), nonce: u64) {
        let sent = wire::encode(nonce, &question).unwrap();
        let frame = wire::read(&mut sent.as_slice(), sent.len()).unwrap();
        prop_assert_eq!(frame.nonce, nonce);
        prop_assert_eq!(bytes(&frame.decode::<Question>().unwrap()), bytes(&question));
    }

    #[test]
    fn answers_round_trip(answer in answer()) {
        let sent = bytes(&answer);
        let frame = wire::read(&mut sent.as_slice(), sent.len()).unwrap();
        prop_assert_eq!(bytes(&frame.decode::<Answer>().unwrap()), sent);
    }

    #[test]
    fn rejects_truncated_answers_and_trailing_bytes(answer in answer(), extra: u8) {
        let sent = bytes(&answer);
        let cut = wire::read(&mut &sent[..sent.len() - 1], sent.len());
        prop_assert!(matches!(cut, Err(WireError::EndOfStream)));

        let mut frame = wire::read(&mut sent.as_slice(), sent.len()).unwrap();
        frame.body.push(extra);
        prop_assert!(matches!(frame.decode::<Answer>(), Err(WireError::TrailingBytes(1))));
    }

    #[test]
    fn random_bytes_never_cause_a_panic(noise: Vec<u8>) {
        if let Ok(frame) = wire::read(&mut noise.as_slice(), 1 << 16) {
            frame.decode::<Answer>().ok();
            frame.decode::<Question>().ok();
        }
    }

    #[test]
    fn answers_fit_the_size_limit_of_their_question(
        rays in prop::collection::vec(ray(), 0..50),
        trace in trace(),
    ) {
        let answer = Answer::Hits(vec![ElementOutcome::Value(Some(trace)); rays.len()]);
        let question = Question::hits(Geometry::List { shapes: Vec::new() }, rays);
        prop_assert!(bytes(&answer).len() <= question.max_answer_bytes());
    }
}

/// A stream that delivers its bytes in pieces and is interrupted between them.
struct Pieces<'a> {
    bytes: &'a [u8],
    sizes: std::iter::Cycle<std::slice::Iter<'a, usize>>,
    is_interrupted: bool,
}

impl std::io::Read for Pieces<'_> {
    fn read(&mut self, buffer: &mut [u8]) -> std::io::Result<usize> {
        self.is_interrupted = !self.is_interrupted;
        if self.is_interrupted {
            return Err(std::io::ErrorKind::Interrupted.into());
        }
        let size = self.sizes.next().map_or(1, |size| *size);
        let size = size.min(buffer.len()).min(self.bytes.len());
        let (piece, rest) = self.bytes.split_at(size);
        buffer[..size].copy_from_slice(piece);
        self.bytes = rest;
        Ok(size)
    }
}

proptest! {
    #[test]
    fn frames_do_not_depend_on_the_pieces_in_which_they_arrive(
        answers in prop::collection::vec((answer(), any::<u64>()), 1..5),
        sizes in prop::collection::vec(1usize..100, 1..20),
    ) {
        let append = |bytes, (answer, nonce): &(Answer, u64)| {
            wire::append(bytes, *nonce, answer).unwrap()
        };
        let bytes = answers.iter().fold(Vec::new(), append);
        let (mut whole, sizes) = (bytes.as_slice(), sizes.iter().cycle());
        let mut pieces = Pieces { bytes: &bytes, sizes, is_interrupted: false };
        for (_, nonce) in &answers {
            let one = wire::read(&mut whole, bytes.len()).unwrap();
            let other = wire::read(&mut pieces, bytes.len()).unwrap();
            prop_assert_eq!(one.nonce, *nonce);
            prop_assert_eq!((one.nonce, one.body), (other.nonce, other.body));
        }
        let end = wire::read(&mut pieces, bytes.len());
        prop_assert!(matches!(end, Err(WireError::EndOfStream)));
    }
}

#[test]
fn rejects_an_oversized_frame_before_reading_its_body() {
    let mut header = u32::MAX.to_le_bytes().to_vec();
    header.extend([0; 8]);
    let result = wire::read(&mut header.as_slice(), 1000);
    assert!(
        matches!(result, Err(WireError::TooLong { length, limit: 1000 }) if length == u32::MAX as usize)
    );
}

#[test]
fn questions_are_sent_one_after_the_other_in_frames_of_any_allowed_length() {
    let question = Question::hits(Geometry::List { shapes: Vec::new() }, Vec::new());
    let mut sent = Vec::new();
    wire::write(&mut sent, 1, &question).unwrap();
    let length = sent.len() - 12;
    let sent = wire::append_question(sent, 2, &question).unwrap();
    let sent = wire::append_end(sent, 3);
    let mut from = sent.as_slice();
    for nonce in [1, 2] {
        let frame = wire::read(&mut from, length).unwrap();
        assert_eq!((frame.nonce, frame.is_end()), (nonce, false));
        assert_eq!(frame.decode::<Question>().unwrap(), question);
    }
    let end = wire::read(&mut from, 0).unwrap();
    assert_eq!((end.nonce, end.is_end()), (3, true));
    assert!(from.is_empty());
}
