//! How large frames are while they play, so that a slow machine holds the frame rate: a pure function of the times that
//! frames have taken.
//!
//! Size alone, at the usual quality: three quarters of a side are nearer to the reference than `fast` is at the whole
//! (41.6 against 40.3 dB in `lumen` at 9.2 s, 43.6 against 42.1 in `day` at 40 s, scaled up to 1280x720), and `fast`
//! hardly helps where triangles and clouds are drawn.

/// Eighths of a side, step by step: frames take 1, 0.73, 0.5 and 0.42 times as long, sizes of 16 by 9 stay it, and so
/// few steps are seldom changed.
pub const EIGHTHS: [usize; 4] = [8, 6, 4, 3];
/// Share of the time that a frame may take below which the next larger one fits too: no step takes half as long again.
const LIGHT: f64 = 0.6;
/// What a late frame adds, and the sum at which there are too many: five in a row, or more than one of five for long.
const LATE: i32 = 4;
const TOO_LATE: i32 = 20;
/// Light frames before a larger size is tried: at first, and at most, which is half a minute and more.
const PATIENCE: i32 = 128;
const MOST_PATIENCE: i32 = 2048;

/// What it knows of the frames so far.
#[derive(Clone, Copy, Debug)]
pub struct Governor {
    /// Place in [`EIGHTHS`].
    pub step: usize,
    /// Above zero late frames, below zero light ones; others bring it back to zero.
    sum: i32,
    /// Light frames to wait for. Each step down doubles it, so no load that comes and goes makes the size follow for long.
    patience: i32,
}

impl Governor {
    /// Begins with whole frames.
    pub fn new() -> Governor {
        Governor { step: 0, sum: 0, patience: PATIENCE }
    }

    /// A frame of the present size has taken that share of the time that it may take.
    pub fn frame(&mut self, share: f64) {
        if share > 1.0 {
            // One late frame, such as the first of a part, is no reason to give up half of the patience and more.
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
                self.patience = (2 * self.patience).min(MOST_PATIENCE);
            }
        } else if self.sum <= -self.patience {
            self.sum = 0;
            self.step = self.step.saturating_sub(1);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::ops::RangeInclusive;

    /// What a step takes of the whole frame's time where every pixel costs the same, and where most of it is fixed.
    const COSTS: [[f64; 4]; 2] = [[1.0, 0.5625, 0.25, 0.140625], [1.0, 0.73, 0.5, 0.42]];
    /// Frames of a minute at 30 a second, the rate to be held.
    const MINUTE: usize = 1800;

    /// Changes of size, and frames that were late, where a whole frame takes `load` of the time.
    fn play(governor: &mut Governor, costs: [f64; 4], frames: usize, load: impl Fn(usize) -> f64) -> (usize, usize) {
        let (mut changes, mut late) = (0, 0);
        for frame in 0..frames {
            let before = governor.step;
            let share = load(frame) * costs[before];
            governor.frame(share);
            changes += usize::from(governor.step != before);
            late += usize::from(share > 1.0);
        }
        (changes, late)
    }

    /// Noise from -1 to 1 that is the same in every run.
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
