//! The time of a scene that plays: real time, which can be paused, moved by keys, and looped.

use crate::args::Args;
use paprsek::cuts;
use paprsek::frame::Scene;
use paprsek::scenes::show::intro::{INTRO, PARTS};
use std::time::Instant;

/// How far an arrow key moves, seconds.
pub const SEEK: f64 = 5.0;
/// How far what is heard may be from the clock for it to follow, seconds.
#[cfg(target_os = "linux")]
const FAR: f64 = 0.2;
/// The share of that by which it comes nearer each time: answers of the server jitter by some milliseconds.
#[cfg(target_os = "linux")]
const NEARER: f64 = 0.1;
/// Shortest duration of a loop, seconds.
const SHORTEST: f64 = 1e-3;

/// The clock of what plays, which the keys move. Times are seconds of the scene.
#[derive(Clone, Copy, Debug)]
pub struct Clock {
    /// The time at `since`, or for as long as the clock rests.
    base: f64,
    /// When the clock was started or moved last; `None` while it rests.
    since: Option<Instant>,
    /// Where a range begins.
    start: f64,
    /// Where playing ends; without it the scene loops.
    end: Option<f64>,
    /// Where the scene ends.
    duration: f64,
    /// Whether the scene is the show, which has parts to jump to.
    show: bool,
}

impl Clock {
    /// A clock that starts now and loops, or ends `once` the scene does; for `--at`, one that rests at its instant.
    pub fn new(args: &Args, once: bool) -> Clock {
        let start = args.start.unwrap_or(0.0);
        let since = (!args.still).then(Instant::now);
        let Scene { name, duration, .. } = *args.scene();
        // Not zero, since the time is taken modulo the duration.
        let duration = duration.max(SHORTEST);
        let end = args.end.or((once && !args.still).then_some(duration));
        Clock { base: start, since, start, end, duration, show: name == INTRO.name }
    }

    /// The time, whatever ends or loops.
    fn raw(&self) -> f64 {
        self.base + self.since.map_or(0.0, |since| since.elapsed().as_secs_f64())
    }

    /// The time to show now; `None` past the end.
    pub fn now(&self) -> Option<f64> {
        let time = self.raw();
        match (self.end, self.since) {
            (Some(end), _) => (time < end).then_some(time),
            // A still is shown as it was asked for, even past the end of the scene.
            (None, None) => Some(time),
            (None, Some(_)) => Some(wrap(time, self.duration)),
        }
    }

    /// Pauses, or continues.
    pub fn toggle(&mut self) {
        self.base = self.now().unwrap_or(self.base);
        self.since = if self.since.is_none() { Some(Instant::now()) } else { None };
    }

    /// Follows what is heard: comes a little nearer to `heard`, the time of the show that sounds now, in seconds, if that
    /// is known. Where it is far away the sound is still to jump, and nothing happens. The time that the sound is to be
    /// at; `None` while time rests and past the end.
    #[cfg(target_os = "linux")]
    pub fn follow(&mut self, heard: Option<f64>) -> Option<f64> {
        if let (Some(heard), Some(_), Some(now)) = (heard, self.since, self.now()) {
            let apart = heard - now;
            if apart.abs() < FAR {
                self.base += apart * NEARER;
            }
        }
        if self.rests() { None } else { self.now() }
    }

    /// Whether time stands still.
    pub fn rests(&self) -> bool {
        self.since.is_none()
    }

    /// Moves by `seconds`.
    pub fn seek(&mut self, seconds: f64) {
        self.go(self.now().unwrap_or(self.base) + seconds);
    }

    /// Goes to the start of a part, counted from 0. Does nothing where there is no such part.
    pub fn jump(&mut self, part: usize) {
        // A scene other than the show has one part, which starts where the show's first does: at 0.
        let parts = if cuts::SCENES && !self.show { &PARTS[..1] } else { PARTS };
        if let Some(part) = parts.get(part) {
            self.go(part.0);
        }
    }

    /// Goes to a time. A looping scene wraps, a range stops at its start.
    fn go(&mut self, time: f64) {
        self.base = if self.end.is_some() { time.max(self.start) } else { wrap(time, self.duration) };
        self.since = self.since.map(|_| Instant::now());
    }
}

/// A time within a loop. Not by `%`, whose exact remainder is 736 bytes of long division.
fn wrap(time: f64, duration: f64) -> f64 {
    (time - (time / duration).floor() * duration).max(0.0)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn still(base: f64, end: Option<f64>) -> Clock {
        Clock { base, since: None, start: 1.0, end, duration: 20.0, show: true }
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
    fn parts_are_where_they_start() {
        let mut clock = Clock { duration: INTRO.duration, ..still(3.0, None) };
        for (number, part) in PARTS.iter().enumerate() {
            clock.jump(number);
            assert_eq!(clock.now(), Some(part.0));
        }
        clock.seek(2.0);
        let there = clock.now();
        clock.jump(PARTS.len());
        assert_eq!(clock.now(), there);
        // A range stops at its start, and a part past its end ends it.
        let mut clock = still(3.0, Some(7.0));
        clock.jump(0);
        assert_eq!(clock.now(), Some(1.0));
        clock.jump(PARTS.len() - 1);
        assert_eq!(clock.now(), if PARTS.len() > 1 { None } else { Some(1.0) });
    }

    #[test]
    fn time_stands_still_while_paused() {
        let mut clock = Clock { since: Some(Instant::now()), ..still(2.0, None) };
        clock.toggle();
        assert!(clock.rests());
        let paused = clock.now();
        assert!(paused >= Some(2.0));
        assert_eq!(clock.now(), paused);
        clock.toggle();
        assert!(clock.now() >= paused);
    }
}
