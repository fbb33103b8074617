//! The viewer as a component of a run: `[[component]] use = "viewer"`.

use super::browser::open_browser;
use super::details::Selected;
use super::look::Looks;
use super::pace::Pace;
use super::page::{LivePage, command};
use super::shared::Shared;
use super::traffic::{ALL_RADIOS_MAX, Traffic};
use super::wind;
use crate::series::Series;
use crate::server::{
    Bell, Options, Page, Picture, Server, ServerError, Source, Visitors, address_of, pictures,
};
use crate::wire::{Asked, Facts, Hello, Mark as Told, Mode, Said};
use simbeeotic_model::kernel::pace::Control;
use simbeeotic_model::kernel::{ModelId, Progress, SimTime};
use simbeeotic_model::physics::Kind;
use simbeeotic_model::radio::{Counters, Loss};
use simbeeotic_model::units::Time;
use simbeeotic_model::{
    BuildError, Component, ComponentError, FromParams, Mark, Note, Summary, Thing, View, component,
    params,
};
use simbeeotic_record::Vehicle;
use simbeeotic_record::stage::{Piece, Stage, pieces_of, textures};
use std::collections::{BTreeMap, BTreeSet};
use std::sync::Arc;
use std::sync::atomic::Ordering;
use std::time::Duration;

/// Marks that one look turns into words.
const MARKS_MAX: usize = 200;

/// Batteries that one sample looks at: those of a large swarm take turns.
const BATTERIES: usize = 128;

/// Virtual time between two samples of the statistics, while the run is slow enough.
const SAMPLE_S: f64 = 0.1;

/// The least and the greatest wall time between two of them.
const SAMPLE_LEAST: Duration = Duration::from_millis(20);
const SAMPLE_MOST: Duration = Duration::from_millis(250);

/// Wall time between two tellings of details, and of the wind.
const DETAILS: Duration = Duration::from_millis(250);
const WIND: Duration = Duration::from_secs(1);

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
    pace: Pace,
    bodies: Vec<ModelId>,
    /// The vehicle that each model is, by id.
    vehicles: Vec<Option<u32>>,
    looks: Looks,
    traffic: Option<Traffic>,
    statistics: Statistics,
    batteries: Batteries,
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

/// Statistics of the run: where they stand among the series, and what they were at the last sample.
#[derive(Default)]
struct Statistics {
    speed: usize,
    contacts: usize,
    sent: usize,
    received: usize,
    delivery: usize,
    energy: usize,
    touches: u64,
    last: Option<(u64, Duration)>,
    last_touches: u64,
    last_air: Counters,
}

/// The vehicles that have batteries, and what each has spent.
#[derive(Default)]
struct Batteries {
    vehicles: Vec<u32>,
    spent_j: Vec<f64>,
    next: usize,
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
            pace: Pace::new(),
            bodies: Vec::new(),
            vehicles: Vec::new(),
            looks: Looks::default(),
            traffic: None,
            statistics: Statistics::default(),
            batteries: Batteries::default(),
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
        })
    }
}

/// What the server shows.
struct Run {
    shared: Arc<Shared>,
    textures: BTreeMap<String, Picture>,
}

impl Source for Run {
    fn open(&self, bell: Arc<Bell>) -> Box<dyn Page> {
        let number = self.shared.enter(bell);
        Box::new(LivePage::new(Arc::clone(&self.shared), number))
    }

    fn command(&self, asked: &Asked) -> Result<bool, String> {
        command(&self.shared, asked)
    }

    fn texture(&self, name: &str) -> Option<Picture> {
        self.textures.get(name).cloned()
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

    /// Makes the first message, and lets pages in.
    fn show(&mut self, view: &View<'_>) -> Result<(), ComponentError> {
        self.bodies = view.bodies().collect();
        self.vehicles = vec![None; view.population().len()];
        for (at, id) in self.bodies.iter().enumerate() {
            self.vehicles[id.index()] = Some(at as u32);
        }
        let origin = view.origin();
        let facts = Facts {
            name: origin.name.clone(),
            seed: origin.seed.cast_signed().to_string(),
            version: origin.version.clone(),
            end_s: view.end().map(SimTime::as_secs_f64),
            truncated: false,
        };
        let vehicles: Vec<Vehicle> = self.bodies.iter().map(|id| vehicle(view, *id)).collect();
        let stage = Stage::of(view.world(), origin.seed);
        let hello = Hello {
            mode: Mode::Live,
            facts: &facts,
            vehicles: &vehicles,
            stage: &stage,
            replay: None,
        };
        let _ = self.shared.hello.set(hello.message());
        let _ = self.shared.vehicles.set(self.bodies.len() as u32);
        let places = &self.vehicles;
        self.traffic = Traffic::new(view, |id| places.get(id).copied().flatten());
        self.start_series(view);
        let url = self.bind().map_err(|e| ComponentError::new(e.to_string()));
        if let Some(server) = &self.server {
            server.show(Arc::new(Run {
                shared: Arc::clone(&self.shared),
                textures: pictures(textures(view.world()).0),
            }));
        }
        url.map(drop)
    }

    fn start_series(&mut self, view: &View<'_>) {
        let mut series = Series::new(self.bodies.len());
        let statistics = &mut self.statistics;
        statistics.speed = series.statistic("speed", "1");
        statistics.contacts = series.statistic("contacts", "1/s");
        if self.traffic.is_some() {
            statistics.sent = series.statistic("packets/sent", "1/s");
            statistics.received = series.statistic("packets/received", "1/s");
            statistics.delivery = series.statistic("packets/delivery", "1");
        }
        let with = self.bodies.iter().enumerate();
        let with = with.filter(|(_, id)| view.battery(**id).is_some());
        self.batteries.vehicles = with.map(|(at, _)| at as u32).collect();
        self.batteries.spent_j = vec![0.0; self.batteries.vehicles.len()];
        if !self.batteries.vehicles.is_empty() {
            statistics.energy = series.statistic("energy", "J");
            for vehicle in &self.batteries.vehicles {
                let id = self.bodies[*vehicle as usize];
                let soc = view.battery(id).map_or(f64::NAN, |battery| battery.soc);
                series.publish("battery/soc", "1", *vehicle, soc);
            }
        }
        *self.shared.series() = series;
    }

    fn vehicle(&self, id: ModelId) -> Option<u32> {
        self.vehicles.get(id.index()).copied().flatten()
    }

    /// Looks at everything that is due.
    fn look(&mut self, view: &View<'_>, held: bool) {
        let wall = self.pace.wall();
        let watched = self.shared.pages.load(Ordering::Acquire) > 0;
        self.heed_wishes(view, watched);
        self.take_marks(view);
        self.take_sample(view, wall, false);
        if watched {
            self.take_frame(view, wall, held);
        }
        match held {
            true => self.pace.stood(),
            false => self.pace.looked(view.now().nanos(), wall, watched),
        }
    }

    /// Looks at what pages want, if that has changed.
    fn heed_wishes(&mut self, view: &View<'_>, watched: bool) {
        let version = self.shared.version.load(Ordering::Acquire);
        if version == self.version {
            return;
        }
        self.version = version;
        let wanted = self.shared.wants().vehicles();
        let known: BTreeSet<u32> = self.selected.keys().copied().collect();
        if wanted != known {
            self.selected.retain(|vehicle, _| wanted.contains(vehicle));
            for vehicle in wanted.difference(&known) {
                if let Some(id) = self.bodies.get(*vehicle as usize) {
                    self.selected.insert(*vehicle, Selected::new(view, *id));
                }
            }
            let path = |vehicle: &u32| {
                view.population()
                    .path(self.bodies[*vehicle as usize])
                    .to_owned()
            };
            self.paths = self.selected.keys().map(path).collect();
            self.detailed = None;
            self.interest += 1;
            let mut now = self.shared.now();
            now.details.retain(|vehicle, _| wanted.contains(vehicle));
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
    }

    /// Takes what has happened since the last look.
    fn take_marks(&mut self, view: &View<'_>) {
        if view.marks().is_empty() {
            return;
        }
        let mut told: Vec<Told> = Vec::new();
        let mut left_out = 0;
        // The newest are told.
        let worth_telling = |mark: &&Mark| matches!(mark, Mark::Touch { .. } | Mark::Log { .. });
        let count = view.marks().iter().filter(worth_telling).count();
        let mut skip = count.saturating_sub(MARKS_MAX);
        let shared = Arc::clone(&self.shared);
        let mut series = None;
        for mark in view.marks() {
            if worth_telling(&mark) && skip > 0 {
                skip -= 1;
                left_out += 1;
                self.statistics.touches += u64::from(matches!(mark, Mark::Touch { .. }));
                continue;
            }
            match mark {
                Mark::Touch { time, a, b } => {
                    self.statistics.touches += 1;
                    told.push(self.contact(view, *time, *a, *b));
                }
                Mark::Log { time, model, text } => told.push(Told {
                    t: time.as_secs_f64(),
                    kind: "log".into(),
                    who: self.vehicle(*model).into_iter().collect(),
                    text: text.clone(),
                }),
                Mark::Metric {
                    model,
                    name,
                    value,
                    unit,
                    ..
                } => {
                    let series = series.get_or_insert_with(|| shared.series());
                    match self.vehicle(*model) {
                        Some(vehicle) => series.publish(name, unit, vehicle, *value),
                        None => {
                            let path = view.population().path(*model);
                            let at = series.statistic(&format!("{path}/{name}"), unit);
                            series.set(at, *value);
                        }
                    }
                }
                Mark::Sensed {
                    time,
                    model,
                    sensor,
                    taken,
                } => {
                    let vehicle = self.vehicle(*model);
                    if let Some(selected) = vehicle.and_then(|v| self.selected.get_mut(&v)) {
                        selected.sensed(*time, *sensor, taken);
                    }
                }
                Mark::OnAir { air, .. } => {
                    if let Some(traffic) = self.traffic.as_mut().filter(|_| self.watched) {
                        traffic.begun(view, air);
                    }
                }
                Mark::Heard { receptions, .. } => {
                    if let Some(traffic) = &mut self.traffic {
                        traffic.heard(receptions);
                    }
                }
                _ => {}
            }
        }
        drop(series);
        if !told.is_empty() {
            let mut now = self.shared.now();
            now.marks.skip(left_out);
            told.into_iter().for_each(|mark| now.marks.push(mark));
        }
    }

    fn contact(&self, view: &View<'_>, time: SimTime, a: ModelId, b: Thing) -> Told {
        let who = std::iter::once(a).chain(b.model());
        Told {
            t: time.as_secs_f64(),
            kind: "contact".into(),
            who: who.filter_map(|id| self.vehicle(id)).collect(),
            text: match b {
                Thing::Ground => "ground".to_owned(),
                Thing::Model(_) => String::new(),
                Thing::Object(object) => match view.world().label_of(object) {
                    "" => object.to_string(),
                    label => format!("{object} {label}"),
                },
            },
        }
    }

    /// Samples the statistics, if it is time.
    fn take_sample(&mut self, view: &View<'_>, wall: Duration, last: bool) {
        let now_ns = view.now().nanos();
        let Some((from_ns, from)) = self.statistics.last else {
            self.statistics.last = Some((now_ns, wall));
            return;
        };
        let passed_s = now_ns.saturating_sub(from_ns) as f64 * 1e-9;
        let waited = wall.saturating_sub(from);
        let due = waited >= SAMPLE_MOST || (passed_s >= SAMPLE_S && waited >= SAMPLE_LEAST);
        if passed_s <= 0.0 || !(due || last) {
            return;
        }
        let statistics = &mut self.statistics;
        statistics.last = Some((now_ns, wall));
        let shared = Arc::clone(&self.shared);
        let mut series = shared.series();
        series.set(statistics.speed, passed_s / waited.as_secs_f64().max(1e-9));
        let touches = statistics.touches - statistics.last_touches;
        statistics.last_touches = statistics.touches;
        series.set(statistics.contacts, touches as f64 / passed_s);
        if self.traffic.is_some() {
            let air = view.radio_counters(None);
            let before = std::mem::replace(&mut statistics.last_air, air);
            let air = statistics.last_air;
            let since =
                |what: fn(&Counters) -> u64| what(&air).saturating_sub(what(&before)) as f64;
            let (sent, received) = (since(|c| c.sent), since(|c| c.received));
            let missed = since(|c| c.missed() - c.lost(Loss::OutOfRange));
            series.set(statistics.sent, sent / passed_s);
            series.set(statistics.received, received / passed_s);
            series.set(statistics.delivery, received / (received + missed));
        }
        let batteries = &mut self.batteries;
        for _ in 0..batteries.vehicles.len().min(BATTERIES) {
            batteries.next = (batteries.next + 1) % batteries.vehicles.len();
            let vehicle = batteries.vehicles[batteries.next];
            let id = self.bodies[vehicle as usize];
            if let Some((state, books)) = view.battery_books(id) {
                series.publish("battery/soc", "1", vehicle, state.soc);
                let spent = books.start - books.stored + books.charged;
                batteries.spent_j[batteries.next] = spent.get();
            }
        }
        if !batteries.vehicles.is_empty() {
            series.set(statistics.energy, batteries.spent_j.iter().sum());
        }
        series.sampled(view.now().as_secs_f64());
    }

    /// Takes a frame and what belongs to it, if it is time and somebody waits for it.
    fn take_frame(&mut self, view: &View<'_>, wall: Duration, held: bool) {
        let period = Duration::from_secs_f64(1.0 / self.params.frames_per_second);
        let since = |last: Option<Duration>| last.map(|last| wall.saturating_sub(last));
        // Not later than the next look but one would be.
        if since(self.framed).is_some_and(|passed| passed + Duration::from_millis(1) < period) {
            return;
        }
        if !self.shared.hungry.swap(false, Ordering::AcqRel) {
            return;
        }
        let now_ns = view.now().nanos();
        let colours = self.colours();
        let same = held && self.framed_ns == Some(now_ns) && colours.is_empty();
        self.framed = Some(wall);
        let ended = self.traffic.as_mut().map(|traffic| traffic.ended(now_ns));
        let links = self
            .traffic
            .as_mut()
            .and_then(|traffic| traffic.links(now_ns));
        let look = (!same).then(|| self.looks.take(view, &self.bodies, colours));
        let wind = (look.as_ref())
            .filter(|_| since(self.winded).is_none_or(|passed| passed >= WIND))
            .map(|look| wind::arrows(view, look));
        if wind.is_some() {
            self.winded = Some(wall);
        }
        let details = match since(self.detailed).is_none_or(|passed| passed >= DETAILS) {
            true => self.details(view, wall),
            false => Vec::new(),
        };
        let mut now = self.shared.now();
        for packet in ended.into_iter().flatten() {
            now.packets.push(Arc::new(packet));
        }
        if let Some((period_s, list)) = links {
            let t = view.now().as_secs_f64();
            now.links.set(Said::Links { t, period_s, list }.message());
        }
        if let Some(arrows) = wind.filter(|arrows| !(self.calm && arrows.is_empty())) {
            self.calm = arrows.is_empty();
            let t = view.now().as_secs_f64();
            now.wind.set(Said::Wind { t, arrows }.message());
        }
        for (vehicle, said) in details {
            now.details.entry(vehicle).or_default().set(said.message());
        }
        if let Some(look) = look {
            now.look = look;
            now.number += 1;
            self.framed_ns = Some(now_ns);
        }
        drop(now);
        self.shared.ring();
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

    /// The numbers that pages want vehicles coloured by.
    fn colours(&self) -> Vec<(String, Arc<[f32]>)> {
        let names = self.shared.wants().colours();
        if names.is_empty() {
            return Vec::new();
        }
        let series = self.shared.series();
        let column = |name: String| {
            let values = series.column(&name)?.into();
            Some((name, values))
        };
        names.into_iter().filter_map(column).collect()
    }
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
        self.shared.now().look = self.looks.take(view, &self.bodies, Vec::new());
        self.shared.now().number = 1;
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
        self.look(view, true);
        Ok(())
    }

    fn finish(&mut self, view: &View<'_>, summary: &Summary) -> Result<Vec<Note>, ComponentError> {
        let wall = self.pace.wall();
        self.take_marks(view);
        self.take_sample(view, wall, true);
        self.framed = None;
        self.shared.hungry.store(true, Ordering::Release);
        self.take_frame(view, wall, false);
        self.shared.now().ended = Some(summary.ended.clone());
        self.shared.ring();
        Ok(Vec::new())
    }
}

/// A vehicle as pages see it.
fn vehicle(view: &View<'_>, id: ModelId) -> Vehicle {
    let member = view.population().get(id);
    let pieces = view.shape(id).map(pieces_of);
    let pieces: Vec<Piece> = pieces.unwrap_or_default();
    let role = view.body_kind(id).unwrap_or(Kind::Vehicle).name();
    let color = view.color(id);
    Vehicle {
        path: member.map(|m| m.path.to_owned()).unwrap_or_default(),
        kind: member.map(|m| m.kind.to_owned()).unwrap_or_default(),
        radius_m: view.radius(id).map_or(0.0, |radius| radius.metres()),
        role: role.to_owned(),
        color: color.map_or([0; 4], |c| [c.red, c.green, c.blue, c.alpha]),
        pieces: pieces.into(),
    }
}
