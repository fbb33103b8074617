//! A MAV's errand: set out, fly the legs of a task, decide what is next.

use super::*;

impl SearchMav {
    /// Sets out for a job, if it reckons that it can come home from there.
    pub(super) fn start(&mut self, job: Job, bee: &mut Bee<'_>) {
        let Some((cells, home)) = self.brief.as_ref().map(|(_, b)| (b.cells, b.home)) else {
            return;
        };
        let there = cells.middle(job.cell.min(cells.len() - 1));
        let here = self.pilot.here.truncate();
        let need = self.cost(here, there) + self.cost(there, home.truncate());
        if self.charge(bee) < need + LEAST_WORK + self.params.reserve {
            if job.ticket != 0 {
                self.radio_hive(&Word::Homeward { ticket: job.ticket }, bee);
            }
            if !matches!(self.phase, Phase::Docked { .. }) {
                self.go_home(bee);
            }
            return;
        }
        self.take_off(bee);
        self.phase = Phase::Out;
        let same = self.log.last().is_some_and(|done| done.cell == job.cell);
        if job.task == Task::Search {
            self.finds = Finds::default();
        } else if !same {
            self.finds = Finds::told(&job.places, self.params.flower_height.metres());
        }
        if self.mind.carries_on() {
            self.radio_all(&Word::Claim { cell: job.cell }, bee);
        }
        let knows = job.task != Task::Search && !self.finds.left().is_empty();
        let stage = if knows { job.task } else { Task::Search };
        self.pilot.clear(bee.now());
        let lanes = cells.lanes(job.cell, self.params.lane.metres(), here);
        let entry = match self
            .finds
            .round(here)
            .first()
            .and_then(|at| self.finds.get(*at))
        {
            Some(find) if knows => find.at.truncate(),
            _ => lanes[0],
        };
        self.cross(entry);
        self.work = Some((job, stage));
        match stage {
            Task::Search => self.add_lanes(&lanes),
            _ => self.add_round(stage),
        }
    }

    pub(super) fn take_off(&mut self, bee: &mut Bee<'_>) {
        if let Phase::Docked { .. } = self.phase {
            bee.hover(true);
            self.asked = false;
            self.pilot.at(self.pilot.here, bee.now());
            bee.metric("idle", self.idle_s, "s");
            bee.metric("unpowered", self.waiting_s, "s");
        }
    }

    /// The height at which it flies from place to place.
    pub(super) fn layer(&self) -> f64 {
        let number = self.brief.as_ref().map_or(0, |(_, brief)| brief.number);
        self.params.height.metres() + 0.75 * f64::from(number % 8)
    }

    /// The way to the work: over all obstacles if it is far.
    pub(super) fn cross(&mut self, entry: DVec2) {
        let (here, up_m) = (self.pilot.here, self.layer());
        let speed_m_s = self.params.speed.get();
        let docked = here.z < 0.5 * self.params.search_height.metres();
        if docked || here.truncate().distance(entry) > NEAR_M {
            self.pilot
                .add(Leg::pass(here.truncate().extend(up_m), speed_m_s));
            self.pilot.add(Leg::pass(entry.extend(up_m), speed_m_s));
        }
        let work = entry.extend(self.params.search_height.metres());
        self.pilot.add(Leg::pass(work, speed_m_s));
    }

    pub(super) fn add_lanes(&mut self, lanes: &[DVec2]) {
        for place in lanes {
            let to = place.extend(self.params.search_height.metres());
            let leg = Leg::pass(to, self.params.search_speed.get());
            self.pilot.add(Leg {
                act: Act::Look,
                ..leg
            });
        }
    }

    /// From flower to flower.
    pub(super) fn add_round(&mut self, task: Task) {
        for which in self.finds.round(self.pilot.here.truncate()) {
            let Some(find) = self.finds.get(which) else {
                continue;
            };
            if task == Task::Sample {
                let over = Leg::pass(find.at + DVec3::Z * SAMPLE_M, 2.0);
                let stay_s = self.params.sample.get();
                self.pilot.add(Leg {
                    act: Act::Sample(which),
                    near_m: 0.5,
                    stay_s,
                    ..over
                });
            } else {
                let over = Leg::pass(find.at + DVec3::Z * OVER_M, 2.0);
                self.pilot.add(Leg {
                    near_m: 0.4,
                    ..over
                });
                let down = Leg::pass(find.at + DVec3::Z * DOWN_M, 1.0);
                let stay_s = self.params.pollinate.get();
                self.pilot.add(Leg {
                    act: Act::Serve(which),
                    near_m: 0.3,
                    stay_s,
                    ..down
                });
            }
        }
    }

    /// All legs are flown.
    pub(super) fn go_on(&mut self, bee: &mut Bee<'_>) {
        match self.phase {
            Phase::Home => self.phase = Phase::Sinks { low: 0 },
            Phase::Out => {
                let after = self
                    .work
                    .as_ref()
                    .and_then(|(job, stage)| self.stage_after(job, *stage));
                match (after, self.work.take()) {
                    (Some(stage), Some((job, _))) => {
                        self.work = Some((job, stage));
                        self.pilot.clear(bee.now());
                        self.add_round(stage);
                    }
                    (None, Some(work)) => {
                        self.work = Some(work);
                        self.finish(true, bee);
                        self.decide(bee);
                    }
                    (_, None) => self.decide(bee),
                }
            }
            Phase::Asks { at, .. }
                if self.mind.carries_on() && (bee.now() - at).secs() > LISTEN_S =>
            {
                self.choose(bee);
            }
            _ => {}
        }
    }

    /// What comes after a stage of a job; `None` if it is done.
    pub(super) fn stage_after(&self, job: &Job, stage: Task) -> Option<Task> {
        let last = if self.mind.carries_on() {
            Task::Pollinate
        } else {
            job.task
        };
        match stage {
            _ if stage >= last || self.finds.left().is_empty() => None,
            // Who was sent to pollinate and had to look first does not sample as well.
            Task::Search if job.task == Task::Pollinate => Some(Task::Pollinate),
            Task::Search => Some(Task::Sample),
            _ => Some(Task::Pollinate),
        }
    }

    /// Notes what came of its work.
    pub(super) fn finish(&mut self, complete: bool, bee: &mut Bee<'_>) {
        let Some((job, stage)) = self.work.take() else {
            return;
        };
        let left = self.finds.left();
        let finding = Finding {
            ticket: job.ticket,
            // Who was to sample or pollinate and could not find the place has searched, no more.
            task: if self.mind.carries_on() || !complete && stage == Task::Search {
                stage
            } else {
                job.task
            },
            cell: job.cell,
            complete,
            count: left.len() as u16,
            places: left,
        };
        if self.mind.carries_on() {
            let left = count_byte(usize::from(finding.count));
            self.radio_all(
                &Word::Mark {
                    cell: job.cell,
                    left,
                },
                bee,
            );
        } else if !complete {
            self.radio_hive(&Word::Homeward { ticket: job.ticket }, bee);
        }
        self.mind.done(&finding);
        self.log.push(finding);
    }

    pub(super) fn decide(&mut self, bee: &mut Bee<'_>) {
        let next = self.mind.go_on();
        self.act(next, bee);
    }

    /// Decides by what the beacons around have answered.
    pub(super) fn choose(&mut self, bee: &mut Bee<'_>) {
        let Some(cells) = self.brief.as_ref().map(|(_, brief)| brief.cells) else {
            return;
        };
        let here = self.pilot.here.truncate();
        let next = self.mind.choose(&cells, here, bee.now(), &mut self.chance);
        self.act(next, bee);
    }
}
