//! The time spent drawing, and the ray rate.

use std::collections::VecDeque;
use std::time::{Duration, Instant};

/// The time window for averaging the ray rate.
const RATE_WINDOW: Duration = Duration::from_secs(2);

/// The time spent drawing a layer, and the rays traced for it.
#[derive(Clone, Debug, Default)]
pub(super) struct Timing {
    /// The end time and the ray count of each request in the last few seconds.
    recent: VecDeque<(Instant, u64)>,
    rays: u64,
    /// The time when drawing of the layer last started.
    since: Option<Instant>,
    drawn_for: Duration,
}

impl Timing {
    /// Starts the clock, unless it is running.
    pub(super) fn start(&mut self, now: Instant) {
        self.since.get_or_insert(now);
    }

    /// Stops the clock, because the layer is complete or a different layer is drawn.
    pub(super) fn stop(&mut self, now: Instant) {
        if let Some(since) = self.since.take() {
            self.drawn_for += now.saturating_duration_since(since);
        }
        self.recent.clear();
    }

    /// Adds the rays of a request.
    pub(super) fn add(&mut self, rays: u64, now: Instant) {
        self.rays += rays;
        self.recent.push_back((now, rays));
        let is_old =
            |(then, _): &(Instant, u64)| now.saturating_duration_since(*then) > RATE_WINDOW;
        while self.recent.front().is_some_and(is_old) {
            self.recent.pop_front();
        }
    }

    /// Returns the time spent drawing the layer.
    pub(super) fn drawn_for(&self, now: Instant) -> Duration {
        let running = self.since.map(|since| now.saturating_duration_since(since));
        self.drawn_for + running.unwrap_or_default()
    }

    /// Returns the rays per second over the last few seconds or, if the clock is stopped, over the
    /// entire time.
    pub(super) fn rays_per_second(&self) -> f64 {
        let (rays, time) = match (self.recent.front(), self.recent.back()) {
            // The first request started before the window.
            (Some((first, _)), Some((last, _))) if first < last => {
                let rays = self.recent.iter().skip(1).map(|(_, rays)| rays).sum();
                (rays, last.saturating_duration_since(*first))
            }
            _ => (self.rays, self.drawn_for),
        };
        if time.is_zero() {
            0.0
        } else {
            rays as f64 / time.as_secs_f64()
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn pauses_count_neither_for_the_time_nor_for_the_rate() {
        let start = Instant::now();
        let at = |milliseconds| start + Duration::from_millis(milliseconds);
        let mut timing = Timing::default();
        timing.start(at(0));
        timing.add(100, at(100));
        timing.add(300, at(200));
        assert_eq!(timing.rays_per_second(), 3000.0);
        timing.stop(at(200));
        assert_eq!(timing.rays_per_second(), 2000.0);
        timing.start(at(60_000));
        timing.add(200, at(60_100));
        timing.add(200, at(60_200));
        assert_eq!(timing.rays_per_second(), 2000.0);
        assert_eq!(timing.drawn_for(at(60_300)), Duration::from_millis(500));
        timing.add(900, at(70_000));
        assert_eq!(timing.recent.len(), 1, "old requests are forgotten");
    }
}
