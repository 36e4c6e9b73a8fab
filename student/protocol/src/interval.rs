use serde::{Deserialize, Deserializer, Serialize, Serializer};

/// The closed interval from `min` to `max`: both ends are included. Empty if `min > max`.
///
/// Used for distances along a ray, whose direction has length one.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Interval {
    /// The smallest number in the interval.
    pub min: f32,
    /// The largest number in the interval. May be `f32::INFINITY`.
    pub max: f32,
}

impl Interval {
    /// The interval `[0, ∞)`: every distance ahead of a ray's origin.
    pub const AHEAD: Interval = Interval {
        min: 0.0,
        max: f32::INFINITY,
    };

    /// Creates the interval from `min` to `max`.
    pub const fn new(min: f32, max: f32) -> Self {
        Interval { min, max }
    }

    /// Returns whether `t` is in the interval. NaN never is.
    pub fn contains(&self, t: f32) -> bool {
        self.min <= t && t <= self.max
    }

    /// Returns whether the interval contains no number. An interval with a NaN end is empty.
    pub fn is_empty(&self) -> bool {
        // `min > max` isn't enough: it is false for NaN, so an interval with a NaN end wouldn't be
        // empty.
        !matches!(
            self.min.partial_cmp(&self.max),
            Some(std::cmp::Ordering::Less | std::cmp::Ordering::Equal)
        )
    }
}

// JSON has no infinity, so an unbounded end is written as `null`. The binary form is two floats.

impl Serialize for Interval {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        if serializer.is_human_readable() {
            let end = |t: f32| t.is_finite().then_some(t);
            (end(self.min), end(self.max)).serialize(serializer)
        } else {
            (self.min, self.max).serialize(serializer)
        }
    }
}

impl<'de> Deserialize<'de> for Interval {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        if deserializer.is_human_readable() {
            let (min, max) = <(Option<f32>, Option<f32>)>::deserialize(deserializer)?;
            Ok(Interval {
                min: min.unwrap_or(f32::NEG_INFINITY),
                max: max.unwrap_or(f32::INFINITY),
            })
        } else {
            let (min, max) = <(f32, f32)>::deserialize(deserializer)?;
            Ok(Interval { min, max })
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn includes_both_ends() {
        let interval = Interval::new(1.0, 2.0);
        assert!(interval.contains(1.0) && interval.contains(2.0));
        assert!(!interval.contains(0.999) && !interval.contains(2.001));
    }

    #[test]
    fn nan_is_in_no_interval() {
        assert!(!Interval::AHEAD.contains(f32::NAN));
        assert!(Interval::new(f32::NAN, 1.0).is_empty());
        assert!(!Interval::new(1.0, 1.0).is_empty());
    }

    #[test]
    fn an_unbounded_end_round_trips_through_json() {
        let text = serde_json::to_string(&Interval::AHEAD).unwrap();
        assert_eq!(text, "[0.0,null]");
        let back: Interval = serde_json::from_str(&text).unwrap();
        assert_eq!(back, Interval::AHEAD);
    }
}
