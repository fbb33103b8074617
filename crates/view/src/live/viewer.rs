//! The viewer as a component of a run: `[[component]] use = "viewer"`.

use super::browser::open_browser;
use super::details::Selected;
use super::look::Looks;
use super::marks::Happened;
use super::opening::Opening;
use super::pace::Pace;
use super::shared::Shared;
use super::statistics::Statistics;
use super::traffic::Traffic;
use crate::series::Series;
use crate::server::{Options, Server, ServerError, Visitors, address_of};
use crate::wire::Said;
use simbeeotic_model::kernel::pace::Control;
use simbeeotic_model::kernel::{ModelId, Progress, SimTime};
use simbeeotic_model::units::Time;
use simbeeotic_model::{
    BuildError, Component, ComponentError, FromParams, Mark, Note, Summary, View, component, params,
};
use simbeeotic_record::{ALL_RADIOS_MAX, Wind};
use std::collections::{BTreeMap, BTreeSet};
use std::sync::Arc;
use std::sync::atomic::Ordering;
use std::thread::JoinHandle;
use std::time::Duration;

/// Wall time between two tellings of details, and of the wind.
const DETAILS: Duration = Duration::from_millis(250);
const WIND: Duration = Duration::from_secs(1);

/// How long the last frame is tried for while pages are at the locks.
const PATIENCE: Duration = Duration::from_secs(1);

/// Shows the run on a page, as it happens: a server on this machine, for a browser.
///
/// `simbeeotic run --view` adds one. Viewing never changes a run, and a page that is slow does not slow
/// it down. From the page the run can be paused, stepped and paced.
#[component("viewer")]
pub struct Viewer {
    params: ViewerParams,
    options: Options,
    shared: Arc<Shared>,
    server: Option<Server>,
    /// Makes the first message.
    opening: Option<JoinHandle<()>>,
    pace: Pace,
    cast: Cast,
    looks: Looks,
    happened: Happened,
    traffic: Option<Traffic>,
    statistics: Statistics,
    selected: BTreeMap<u32, Selected>,
    /// The paths of selected vehicles.
    paths: BTreeSet<String>,
    /// What pages wanted when it was looked at last.
    version: u64,
    interest: u64,
    watched: bool,
    /// Wall times of the last of each.
    framed: Option<Duration>,
    framed_ns: Option<u64>,
    detailed: Option<Duration>,
    winded: Option<Duration>,
    /// Whether there was no wind at all.
    calm: bool,
    /// The run has ended: what pages ask for is told of its end.
    over: bool,
}

/// Parameters of [`Viewer`].
#[params]
pub struct ViewerParams {
    /// The address to serve at. Any but one of loopback can be reached from other machines: then the page
    /// needs the token in the address that is printed.
    pub address: String,
    /// The port to serve at, 0 for any that is free. Unless said: 8470 if it is free, else any.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub port: Option<u16>,
    /// Frames that a page is sent in a second of wall time at most, 1 to 240.
    pub frames_per_second: f64,
    /// Whether the run waits for the page to let it go.
    pub paused: bool,
    /// Whether the browser is started.
    pub open: bool,
}

impl Default for ViewerParams {
    fn default() -> Self {
        Self {
            address: "127.0.0.1".to_owned(),
            port: None,
            frames_per_second: 30.0,
            paused: false,
            open: false,
        }
    }
}

/// Who flies.
#[derive(Default)]
pub(super) struct Cast {
    /// The models that are vehicles, by the vehicles' numbers.
    pub(super) bodies: Vec<ModelId>,
    /// The vehicle that each model is, by id.
    vehicles: Vec<Option<u32>>,
}

impl Cast {
    fn of(view: &View<'_>) -> Self {
        let bodies: Vec<ModelId> = view.bodies().collect();
        let mut vehicles = vec![None; view.population().len()];
        for (vehicle, id) in (0..).zip(&bodies) {
            vehicles[id.index()] = Some(vehicle);
        }
        Self { bodies, vehicles }
    }

    /// The vehicle that a model is, if it is one.
    pub(super) fn vehicle(&self, id: ModelId) -> Option<u32> {
        self.vehicles.get(id.index()).copied().flatten()
    }
}

impl FromParams for Viewer {
    type Params = ViewerParams;

    fn from_params(params: ViewerParams) -> Result<Self, BuildError> {
        let address =
            address_of(&params.address).map_err(|help| BuildError::parameter("address", help))?;
        let frames = params.frames_per_second;
        if !(1.0..=240.0).contains(&frames) {
            return Err(BuildError::parameter(
                "frames_per_second",
                format!("{frames} is not between 1 and 240"),
            ));
        }
        Ok(Self {
            options: Options {
                address,
                port: params.port,
            },
            params,
            shared: Arc::new(Shared::new()),
            server: None,
            opening: None,
            pace: Pace::new(),
            cast: Cast::default(),
            looks: Looks::default(),
            happened: Happened::default(),
            traffic: None,
            statistics: Statistics::default(),
            selected: BTreeMap::new(),
            paths: BTreeSet::new(),
            version: 0,
            interest: 0,
            watched: false,
            framed: None,
            framed_ns: None,
            detailed: None,
            winded: None,
            calm: false,
            over: false,
        })
    }
}

impl Viewer {
    /// Its parameters.
    pub fn params(&self) -> &ViewerParams {
        &self.params
    }

    /// Takes the port now, and returns the address of the page; pages that come wait for the run to start.
    /// Without this, that happens when the run starts.
    ///
    /// # Errors
    /// See [`ServerError`].
    pub fn bind(&mut self) -> Result<String, ServerError> {
        if self.server.is_none() {
            self.server = Some(Server::start(self.options)?);
        }
        Ok(self.server.as_ref().map(Server::url).unwrap_or_default())
    }

    /// Who looks at its page; `None` before it is [bound](Self::bind).
    pub fn visitors(&self) -> Option<Visitors> {
        Some(self.server.as_ref()?.visitors())
    }

    /// Sees who there is, and lets pages in.
    fn show(&mut self, view: &View<'_>) -> Result<(), ComponentError> {
        self.bind()
            .map_err(|e| ComponentError::new(e.to_string()))?;
        self.cast = Cast::of(view);
        let cast = &self.cast;
        self.traffic = Traffic::new(view, cast);
        let _ = self.shared.vehicles.set(cast.bodies.len() as u32);
        let mut series = Series::new(cast.bodies.len());
        self.statistics = Statistics::start(view, cast, self.traffic.is_some(), &mut series);
        *self.shared.series() = series;
        let look = self.looks.take(view, &cast.bodies, Vec::new());
        let mut now = self.shared.now();
        (now.look, now.number) = (look, 1);
        drop(now);
        if let Some(server) = &self.server {
            self.opening = Opening::of(view, cast).show(&self.shared, server.screen());
        }
        Ok(())
    }

    /// Looks at everything that is due.
    fn look(&mut self, view: &View<'_>, held: bool) {
        let wall = self.pace.wall();
        // The version first: who comes and goes counts the pages first, so that this version's pages are known, or
        // those of a later one, which is looked at the next time.
        let version = self.shared.version.load(Ordering::Acquire);
        let watched = self.shared.pages.load(Ordering::Acquire) > 0;
        self.heed_wishes(view, version, watched);
        self.take_marks(view);
        self.happened.hand_over(view, &self.cast, &self.shared);
        self.take_sample(view, wall, held, false);
        if held {
            self.statistics.stood(view.now().nanos(), wall);
        }
        if watched {
            self.take_frame(view, wall, held);
        }
        match held {
            true => self.pace.stood(),
            false => self.pace.looked(view.now().nanos(), wall, watched),
        }
    }

    /// Looks at what pages want, if that has changed.
    fn heed_wishes(&mut self, view: &View<'_>, version: u64, watched: bool) {
        if version == self.version {
            return;
        }
        let Some(wanted) = self.shared.try_wants().map(|wants| wants.vehicles()) else {
            return;
        };
        let known: BTreeSet<u32> = self.selected.keys().copied().collect();
        if wanted != known {
            let Some(mut now) = self.shared.try_now() else {
                return;
            };
            now.details.retain(|vehicle, _| wanted.contains(vehicle));
            self.selected.retain(|vehicle, _| wanted.contains(vehicle));
            for vehicle in wanted.difference(&known) {
                if let Some(id) = self.cast.bodies.get(*vehicle as usize) {
                    self.selected.insert(*vehicle, Selected::new(view, *id));
                }
            }
            let path = |vehicle: &u32| {
                let id = self.cast.bodies[*vehicle as usize];
                view.population().path(id).to_owned()
            };
            self.paths = self.selected.keys().map(path).collect();
            self.detailed = None;
            self.interest += 1;
            if let Some(traffic) = &mut self.traffic {
                let known = now.packets.iter().rev().map(|packet| &**packet);
                traffic.select(wanted, known);
            }
        }
        if watched != self.watched {
            self.watched = watched;
            self.interest += 1;
            if let Some(traffic) = self.traffic.as_mut().filter(|_| !watched) {
                traffic.forget();
            }
        }
        self.version = version;
    }

    /// Takes what has happened since the last look.
    fn take_marks(&mut self, view: &View<'_>) {
        if view.marks().is_empty() {
            return;
        }
        self.happened.take(view, &self.cast);
        if self.traffic.is_none() && self.selected.is_empty() {
            return;
        }
        for mark in view.marks() {
            match mark {
                Mark::Sensed {
                    time,
                    model,
                    sensor,
                    taken,
                } => {
                    let vehicle = self.cast.vehicle(*model);
                    if let Some(selected) = vehicle.and_then(|v| self.selected.get_mut(&v)) {
                        selected.sensed(*time, *sensor, taken);
                    }
                }
                Mark::OnAir { air, .. } => {
                    if let Some(traffic) = self.traffic.as_mut().filter(|_| self.watched) {
                        traffic.begun(view, air);
                    }
                }
                Mark::Heard { time, receptions } => {
                    if let Some(traffic) = &mut self.traffic {
                        traffic.heard(*time, receptions);
                    }
                }
                _ => {}
            }
        }
    }

    /// Samples the statistics, if it is time and nobody else is at them.
    fn take_sample(&mut self, view: &View<'_>, wall: Duration, held: bool, last: bool) {
        if !self.statistics.due(view.now().nanos(), wall, last) {
            return;
        }
        let shared = Arc::clone(&self.shared);
        let series = match last {
            true => Some(shared.series()),
            false => shared.try_series(),
        };
        if let Some(mut series) = series {
            let touches = self.happened.touches;
            let at = (wall, self.watched, held);
            self.statistics
                .sample(view, &self.cast, at, touches, &mut series);
        }
    }

    /// Takes a frame and what belongs to it, if it is time and somebody waits for it.
    fn take_frame(&mut self, view: &View<'_>, wall: Duration, held: bool) {
        let period = Duration::from_secs_f64(1.0 / self.params.frames_per_second);
        let since = |last: Option<Duration>| last.map(|last| wall.saturating_sub(last));
        // Not later than the next look but one would be.
        if since(self.framed).is_some_and(|passed| passed + Duration::from_millis(1) < period) {
            return;
        }
        let Some(colours) = self.colours() else {
            return;
        };
        let shared = Arc::clone(&self.shared);
        let Some(mut now) = shared.try_now() else {
            return;
        };
        if !shared.hungry.swap(false, Ordering::AcqRel) {
            return;
        }
        let now_ns = view.now().nanos();
        let t = view.now().as_secs_f64();
        let known = &now.look.colours;
        // Once more only in other colours.
        let same = held && self.framed_ns == Some(now_ns) && alike(&colours, known);
        self.framed = Some(wall);
        if let Some(traffic) = &mut self.traffic {
            for packet in traffic.ended(now_ns) {
                now.packets.push(Arc::new(packet));
            }
            if let Some((period_s, list)) = traffic.links(now_ns) {
                now.links.set(Said::Links { t, period_s, list });
            }
        }
        if since(self.detailed).is_none_or(|passed| passed >= DETAILS) {
            for (vehicle, said) in self.details(view, wall) {
                now.details.entry(vehicle).or_default().set(said);
            }
        }
        if !same {
            now.look = self.looks.take(view, &self.cast.bodies, colours);
            now.number += 1;
            self.framed_ns = Some(now_ns);
            if since(self.winded).is_none_or(|passed| passed >= WIND) {
                self.winded = Some(wall);
                let around = now.look.columns.positions.iter().copied();
                let arrows = Wind::around(view, around).arrows;
                if !(self.calm && arrows.is_empty()) {
                    self.calm = arrows.is_empty();
                    now.wind.set(Said::Wind { t, arrows });
                }
            }
        }
        drop(now);
        shared.ring();
    }

    fn details(&mut self, view: &View<'_>, wall: Duration) -> Vec<(u32, Said)> {
        self.detailed = Some(wall);
        let packets = |vehicle: &u32| {
            let traffic = self.traffic.as_ref();
            let list = traffic.and_then(|traffic| traffic.remembered.get(vehicle));
            list.map(|list| list.iter().cloned().collect())
                .unwrap_or_default()
        };
        let selected = self.selected.iter();
        selected
            .map(|(at, selected)| (*at, Said::Details(selected.tell(view, *at, packets(at)))))
            .collect()
    }

    /// After the end: tells of whom a page has selected since.
    fn answer(&mut self, view: &View<'_>) {
        let version = self.shared.version.load(Ordering::Acquire);
        if version == self.version {
            return;
        }
        let watched = self.shared.pages.load(Ordering::Acquire) > 0;
        self.heed_wishes(view, version, watched);
        if self.detailed.is_some() {
            return;
        }
        let shared = Arc::clone(&self.shared);
        let told = self.details(view, self.pace.wall());
        let mut now = shared.now();
        for (vehicle, said) in told {
            now.details.entry(vehicle).or_default().set(said);
        }
        drop(now);
        shared.ring();
    }

    /// The numbers that pages want vehicles coloured by; `None`: somebody else is at them.
    fn colours(&self) -> Option<Vec<(String, Arc<[f32]>)>> {
        let names = self.shared.try_wants()?.colours();
        if names.is_empty() {
            return Some(Vec::new());
        }
        let series = self.shared.try_series()?;
        let column = |name: String| {
            let values = series.column(&name)?.into();
            Some((name, values))
        };
        Some(names.into_iter().filter_map(column).collect())
    }
}

/// Whether these are the same numbers of the same names.
fn alike(some: &[(String, Arc<[f32]>)], others: &[(String, Arc<[f32]>)]) -> bool {
    some.len() == others.len()
        && some
            .iter()
            .zip(others)
            .all(|((name, values), (other, others))| {
                let same = |(x, y): (&f32, &f32)| x.to_bits() == y.to_bits();
                name == other && values.iter().zip(others.iter()).all(same)
            })
}

impl Component for Viewer {
    /// It has a clock of its own; this is its first step.
    fn period(&self) -> Option<Time> {
        Some(Time::from_secs(0.001))
    }

    fn wants_reading(&self, sensor: &str) -> bool {
        let owner = sensor.rsplit_once('/').map(|(owner, _)| owner);
        owner.is_some_and(|owner| self.paths.contains(owner))
    }

    fn wants_packets(&self, radio: &str, among: usize) -> bool {
        let owner = radio.rsplit_once('/').map(|(owner, _)| owner);
        let selected = owner.is_some_and(|owner| self.paths.contains(owner));
        self.watched && (among <= ALL_RADIOS_MAX || selected)
    }

    fn interest(&self) -> u64 {
        self.interest
    }

    fn attach(&mut self, control: &Arc<Control>, progress: &Arc<Progress>) {
        let _ = self.shared.control.set(Arc::clone(control));
        let _ = self.shared.progress.set(Arc::clone(progress));
        if self.params.paused {
            control.pause();
        }
    }

    fn next_observation(&self, now: SimTime) -> Option<SimTime> {
        now.checked_add_nanos(self.pace.step_ns())
    }

    fn start(&mut self, view: &View<'_>) -> Result<(), ComponentError> {
        let bound = self.server.is_some();
        self.show(view)?;
        // A program that has bound it has shown its address, too.
        if let Some(server) = self.server.as_ref().filter(|_| self.params.open && !bound) {
            let _ = open_browser(&server.url());
        }
        Ok(())
    }

    fn observe(&mut self, view: &View<'_>) -> Result<(), ComponentError> {
        self.look(view, false);
        Ok(())
    }

    fn held(&mut self, view: &View<'_>) -> Result<(), ComponentError> {
        match self.over {
            true => self.answer(view),
            false => self.look(view, true),
        }
        Ok(())
    }

    fn finish(&mut self, view: &View<'_>, summary: &Summary) -> Result<Vec<Note>, ComponentError> {
        // Now there is time to wait for pages.
        if let Some(opening) = self.opening.take() {
            let _ = opening.join();
        }
        let wall = self.pace.wall();
        self.take_marks(view);
        let shared = Arc::clone(&self.shared);
        self.happened
            .publish(view, &self.cast, &mut shared.series());
        self.statistics
            .look_at_all(view, &self.cast, &mut shared.series());
        self.take_sample(view, wall, false, true);
        let deadline = wall + PATIENCE;
        loop {
            let version = shared.version.load(Ordering::Acquire);
            let watched = shared.pages.load(Ordering::Acquire) > 0;
            self.heed_wishes(view, version, watched);
            self.happened.hand_over(view, &self.cast, &shared);
            shared.hungry.store(true, Ordering::Release);
            self.framed = None;
            self.take_frame(view, self.pace.wall(), false);
            let all = self.framed.is_some() && !self.happened.waits();
            if all || self.pace.wall() > deadline {
                break;
            }
            std::thread::sleep(Duration::from_millis(1));
        }
        let details = self.details(view, self.pace.wall());
        self.over = true;
        let mut now = shared.now();
        for (vehicle, said) in details {
            now.details.entry(vehicle).or_default().set(said);
        }
        now.ended = Some(summary.ended.clone());
        drop(now);
        shared.ring();
        Ok(Vec::new())
    }
}
