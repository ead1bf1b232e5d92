//! The time of a scene that plays: real time, paused, moved by hand, looped.

use crate::args::Args;
use std::time::Instant;

/// What the keys move.
#[derive(Clone, Copy, Debug)]
pub struct Clock {
    /// Scene time at `since`, or for good while `since` is `None`.
    base: f64,
    since: Option<Instant>,
    start: f64,
    /// Where playing ends; the scene loops without it.
    end: Option<f64>,
    duration: f64,
}

impl Clock {
    /// A clock that starts now. `--at` starts paused at its instant.
    pub fn new(args: &Args) -> Clock {
        let start = args.start.unwrap_or(0.0);
        let since = (!args.still).then(Instant::now);
        // Not zero, since time is taken modulo the duration.
        Clock { base: start, since, start, end: args.end, duration: args.scene().duration.max(1e-3) }
    }

    /// The same clock, but ending with the scene instead of looping.
    #[cfg(all(unix, feature = "terminal"))]
    pub fn once(self) -> Clock {
        let still = self.since.is_none();
        Clock { end: self.end.or((!still).then_some(self.duration)), ..self }
    }

    fn raw(&self) -> f64 {
        self.base + self.since.map_or(0.0, |since| since.elapsed().as_secs_f64())
    }

    /// The scene time to show now; `None` past the end.
    pub fn now(&self) -> Option<f64> {
        let time = self.raw();
        match (self.end, self.since) {
            (Some(end), _) => (time < end).then_some(time),
            // A still is shown as asked for, even past the end of the scene.
            (None, None) => Some(time),
            (None, Some(_)) => Some(wrap(time, self.duration)),
        }
    }

    /// Stops, or goes on.
    pub fn toggle(&mut self) {
        self.base = self.now().unwrap_or(self.base);
        self.since = if self.since.is_none() { Some(Instant::now()) } else { None };
    }

    /// Moves by `seconds`; a looping scene wraps, a range stops at its start.
    pub fn seek(&mut self, seconds: f64) {
        let target = self.now().unwrap_or(self.base) + seconds;
        self.base = if self.end.is_some() { target.max(self.start) } else { wrap(target, self.duration) };
        self.since = self.since.map(|_| Instant::now());
    }
}

/// A time within a loop. The exact remainder, `%`, is 736 bytes of long division.
fn wrap(time: f64, duration: f64) -> f64 {
    (time - (time / duration).floor() * duration).max(0.0)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn still(base: f64, end: Option<f64>) -> Clock {
        Clock { base, since: None, start: 1.0, end, duration: 20.0 }
    }

    #[test]
    fn a_still_shows_the_instant_that_was_asked_for() {
        assert_eq!(still(33.25, None).now(), Some(33.25));
    }

    #[test]
    fn a_loop_wraps_both_ways() {
        let mut clock = still(18.0, None);
        clock.seek(5.0);
        assert_eq!(clock.now(), Some(3.0));
        clock.seek(-5.0);
        assert_eq!(clock.now(), Some(18.0));
    }

    #[test]
    fn a_range_stops_at_its_start_and_ends_at_its_end() {
        let mut clock = still(3.0, Some(7.0));
        clock.seek(-5.0);
        assert_eq!(clock.now(), Some(1.0));
        clock.seek(5.0);
        clock.seek(1.0);
        assert_eq!(clock.now(), None);
    }

    #[test]
    fn time_stands_still_while_paused() {
        let mut clock = Clock { since: Some(Instant::now()), ..still(2.0, None) };
        clock.toggle();
        let paused = clock.now();
        assert!(paused >= Some(2.0));
        assert_eq!(clock.now(), paused);
        clock.toggle();
        assert!(clock.now() >= paused);
    }
}
