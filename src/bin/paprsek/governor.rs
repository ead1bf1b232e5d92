//! The size of frames while they play: smaller ones where the machine is too slow for the frame rate.
//!
//! A governor is a pure function of the times that frames have taken. Late frames count up, light ones count down, and
//! at a limit of either the size goes down or up by one step. A step up is a trial, for which light frames have to come
//! for long, and each step down doubles how many of them.
//!
//! Only the size gives way, never the quality: at three quarters of each side a frame is nearer to the reference than
//! `fast` is at the whole (41.6 against 40.3 dB in `lumen` at 9.2 s, 43.6 against 42.1 in `day` at 40 s, scaled up to
//! 1280x720), and
//! `fast` hardly helps where triangles and clouds are drawn.

/// The sizes, in eighths of each side. Frames take 1, 0.73, 0.5 and 0.42 times as long; 16:9 stays 16:9; and with so
/// few steps the size seldom changes.
pub const EIGHTHS: [usize; 4] = [8, 6, 4, 3];
/// The whole size's place in [`EIGHTHS`].
pub const WHOLE: usize = 0;
/// A frame that takes less than this share of its time is light: the next larger size fits too, because no step takes
/// half as long again as the one below it.
const LIGHT: f64 = 0.6;
/// What a late frame adds to the sum.
const LATE: i32 = 4;
/// The sum at which the size goes down: after five late frames in a row, or more than one in five for long.
const TOO_LATE: i32 = 20;
/// Light frames before a larger size is tried, at first.
const TRIAL: i32 = 128;
/// Light frames before a larger size is tried, at most: more than half a minute.
const MAX_TRIAL: i32 = 2048;

/// What is known of the frames so far.
#[derive(Clone, Copy, Debug)]
pub struct Governor {
    /// The present size, as a place in [`EIGHTHS`].
    pub step: usize,
    /// Late frames take it above zero, light ones below, and others bring it back to zero.
    sum: i32,
    /// Light frames before a larger size is tried. Each step down doubles them, so that the size does not follow for
    /// long a load that comes and goes.
    trial: i32,
}

impl Governor {
    /// A governor that begins with the whole size.
    pub fn new() -> Governor {
        Governor { step: WHOLE, sum: 0, trial: TRIAL }
    }

    /// Takes note of a frame of the present size, which took this share of the time that it may take.
    pub fn record(&mut self, share: f64) {
        if share > 1.0 {
            // A single late frame, such as the first of a part, loses half of the light ones before it, and not all.
            self.sum = if self.sum < 0 { self.sum / 2 } else { self.sum + LATE };
        } else if share < LIGHT {
            self.sum -= 1;
        } else {
            self.sum -= self.sum.signum();
        }
        if self.sum >= TOO_LATE {
            self.sum = 0;
            if self.step + 1 < EIGHTHS.len() {
                self.step += 1;
                self.trial = (2 * self.trial).min(MAX_TRIAL);
            }
        } else if self.sum <= -self.trial {
            self.sum = 0;
            self.step = self.step.saturating_sub(1);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::ops::RangeInclusive;

    /// The time of each step as a share of the whole frame's, where every pixel costs the same, and where most of the
    /// cost is fixed.
    const COSTS: [[f64; 4]; 2] = [[1.0, 0.5625, 0.25, 0.140625], [1.0, 0.73, 0.5, 0.42]];
    /// Frames of a minute at 30 per second, the rate to be held.
    const MINUTE: usize = 1800;

    /// Plays frames of which the whole size would take `load` of the time. Gives how often the size changed, and how
    /// many frames were late.
    fn play(governor: &mut Governor, costs: [f64; 4], frames: usize, load: impl Fn(usize) -> f64) -> (usize, usize) {
        let (mut changes, mut late) = (0, 0);
        for frame in 0..frames {
            let before = governor.step;
            let share = load(frame) * costs[before];
            governor.record(share);
            changes += usize::from(governor.step != before);
            late += usize::from(share > 1.0);
        }
        (changes, late)
    }

    /// Noise from -1 to 1, the same in every run.
    fn noise(frame: usize) -> f64 {
        let x = (frame as f64 * 12.9898).sin() * 43758.5453;
        2.0 * (x - x.floor()) - 1.0
    }

    fn within(what: &str, number: usize, range: RangeInclusive<usize>) {
        assert!(range.contains(&number), "{what}: {number}");
    }

    #[test]
    fn a_steady_load_settles_in_a_second_and_stays() {
        for costs in COSTS {
            for load in [0.1, 0.5, 0.9, 1.1, 1.5, 2.0, 2.3] {
                let mut governor = Governor::new();
                play(&mut governor, costs, 30, |_| load);
                let step = governor.step;
                assert!(load * costs[step] <= 1.0, "{load}: {step}");
                // At most two larger sizes are tried in vain.
                let (changes, late) = play(&mut governor, costs, MINUTE, |_| load);
                within("changes", changes, 0..=4);
                within("late frames", late, 0..=10);
            }
        }
    }

    #[test]
    fn a_load_above_every_step_stays_at_the_last() {
        let mut governor = Governor::new();
        assert_eq!(play(&mut governor, COSTS[0], MINUTE, |_| 20.0).0, EIGHTHS.len() - 1);
        assert_eq!(governor.step, EIGHTHS.len() - 1);
    }

    #[test]
    fn a_load_that_rises_is_answered_and_one_that_falls_too() {
        for costs in COSTS {
            let mut governor = Governor::new();
            play(&mut governor, costs, MINUTE, |_| 0.3);
            assert_eq!(governor.step, 0);
            let (_, late) = play(&mut governor, costs, MINUTE, |_| 1.5);
            assert_ne!(governor.step, 0);
            // The first, and those of the trials of a larger size.
            within("late frames", late, 1..=20);
            play(&mut governor, costs, 3 * MINUTE, |_| 0.3);
            assert_eq!(governor.step, 0);
        }
    }

    #[test]
    fn noise_and_single_late_frames_change_nothing() {
        for (load, most) in [(0.4, 0.3), (0.8, 0.19), (0.85, 0.17)] {
            let mut governor = Governor::new();
            let noisy = |frame| load + most * noise(frame) + if frame % 30 == 7 { 10.0 } else { 0.0 };
            assert_eq!(play(&mut governor, COSTS[1], 10 * MINUTE, noisy).0, 0, "{load}");
        }
    }

    #[test]
    fn a_load_between_two_steps_is_not_a_reason_to_swing() {
        for costs in COSTS {
            // From the least load that is late at the whole size to the largest that three quarters take.
            for tenth in 0..10 {
                let load = 1.01 + f64::from(tenth) * 0.03;
                for spread in [0.0, 0.05, 0.3] {
                    let mut governor = Governor::new();
                    let (changes, _) = play(&mut governor, costs, MINUTE, |frame| load + spread * noise(frame));
                    within("changes in the first minute", changes, 1..=6);
                    let (changes, _) = play(&mut governor, costs, MINUTE, |frame| load + spread * noise(frame));
                    within("changes in the second", changes, 0..=2);
                }
            }
        }
    }

    #[test]
    fn no_two_loads_in_turn_make_it_swing() {
        let loads = [0.0, 0.3, 0.55, 0.8, 1.05, 1.5, 2.5, 5.0, 9.0];
        for costs in COSTS {
            for low in loads {
                for high in loads {
                    for period in [1, 2, 3, 5, 10, 30, 100, 135, 150, 300, 600, 1000, 2100] {
                        let mut governor = Governor::new();
                        let turn = |frame: usize| if (frame / period).is_multiple_of(2) { high } else { low };
                        let (changes, _) = play(&mut governor, costs, MINUTE, turn);
                        within("changes in the first minute", changes, 0..=8);
                        play(&mut governor, costs, 2 * MINUTE, turn);
                        let (changes, _) = play(&mut governor, costs, 10 * MINUTE, turn);
                        within("changes in ten minutes", changes, 0..=20);
                    }
                }
            }
        }
    }
}
