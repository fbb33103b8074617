//! The map of links: who hears whom, and how well, from above.

use super::super::Failure;
use super::arguments::LinkOptions;
use super::axes::{Panel, grouped, nice, number};
use super::ground::Ground;
use super::map::{Column, Names, axes, heading, maps, scale_bar};
use super::net::{Net, Pair, Way, strongest};
use super::palette::ramp;
use super::sheet::{Anchor, FAINT, GRID, Ink, SMALL, Sheet};
use super::source::{Source, Sources};
use super::sweep::{Group, map_groups};

/// More names hide what is below.
const NAMES_MAX: usize = 60;
/// In less, names and legend find no room, pixels.
const WIDTH_MIN: u32 = 400;
const HEIGHT_MIN: u32 = 300;
const NODE: Ink = Ink::new([0x26, 0x2b, 0x33]);
/// A delivery ratio that may be farther off than this is drawn dashed.
const UNSURE: f64 = 0.1;
/// So few links have their numbers beside them.
const NUMBERS_MAX: usize = 8;

/// One map.
struct Map {
    name: String,
    net: Net,
    /// How many links there are in all, and how many of each radio are drawn, if not all.
    all: usize,
    best: Option<usize>,
    ground: Option<Ground>,
}

/// The map.
pub(super) fn links(sources: &Sources, options: &LinkOptions) -> Result<Sheet, Failure> {
    let least = options.least;
    if !(0.0..=1.0).contains(&least) {
        return Err(Failure::input(format!(
            "--least {least}: a delivery ratio lies between 0 and 1"
        )));
    }
    if options.per_radio == Some(0) {
        return Err(Failure::input("--per-radio 0: it must be one or more"));
    }
    let [width, height] = options.plot.size();
    if width < WIDTH_MIN || height < HEIGHT_MIN {
        return Err(Failure::input(format!(
            "--width {width} --height {height}: a map of links needs at least {WIDTH_MIN} x {HEIGHT_MIN} \
             pixels"
        )));
    }
    let groups = map_groups(sources, options.by.as_deref())?;
    let maps = groups.iter().map(|group| Map::of(group, options));
    let maps: Vec<Map> = maps.collect::<Result<_, _>>()?;
    let times = || maps.iter().map(|map| map.net.times_ns);
    let first = times().map(|times| times[0]).min().unwrap_or(0);
    let last = times().map(|times| times[1]).max().unwrap_or(0);
    let mut what = match maps.as_slice() {
        [map] => map.said(),
        maps => format!("{} maps", maps.len()),
    };
    let several = groups.iter().any(|group| group.runs.len() > 1);
    if several {
        what += ", mean over runs";
    }
    let title = options.plot.title("Links");
    let mut sheet = Sheet::titled(width, height, title, &sources.caption(first, last, &what));
    draw(&mut sheet, &maps, least, several);
    Ok(sheet)
}

impl Map {
    fn of(group: &Group, options: &LinkOptions) -> Result<Self, Failure> {
        let mut net = Net::read(&group.runs, options.time.as_deref())?;
        net.pairs
            .retain(|pair| pair.ways.iter().any(|way| is_drawn(way, options.least)));
        let all = net.pairs.len();
        let wanted = options.per_radio.map(|n| n as usize);
        let (pairs, best) = strongest(std::mem::take(&mut net.pairs), net.radios.len(), wanted);
        net.pairs = pairs;
        let (stage, _) = Source::common_stage(&group.runs)?;
        Ok(Self {
            name: group.name.clone(),
            net,
            all,
            best,
            ground: stage.map(|stage| Ground::of(&stage, &[])),
        })
    }

    /// How many links it shows.
    fn counted(&self) -> String {
        match (self.net.pairs.len(), self.all) {
            (drawn, all) if drawn < all => {
                format!("{drawn} of {} links", grouped(&all.to_string()))
            }
            (_, all) => format!("{} links", grouped(&all.to_string())),
        }
    }

    /// How many radios and links it shows.
    fn said(&self) -> String {
        let (radios, all) = (self.net.radios.len(), grouped(&self.all.to_string()));
        match self.best {
            Some(1) => {
                let drawn = self.net.pairs.len();
                format!("{radios} radios, the best link of each ({drawn} of {all})")
            }
            Some(best) => {
                let drawn = self.net.pairs.len();
                format!("{radios} radios, the {best} best links of each ({drawn} of {all})")
            }
            None => format!("{radios} radios, {all} links"),
        }
    }
}

fn is_drawn(way: &Way, least: f64) -> bool {
    way.heard && way.ratio >= least
}

/// What the widths of lines say.
#[derive(Clone, Copy)]
struct Levels {
    low: f64,
    high: f64,
    step: f64,
}

impl Levels {
    fn of(maps: &[Map]) -> Option<Self> {
        let pairs = maps.iter().flat_map(|map| &map.net.pairs);
        let heard = pairs.flat_map(|pair| pair.ways).filter(|way| way.heard);
        let ends = heard.map(|way| [way.rssi_dbm; 2]);
        let [low, high] = ends.reduce(|a, b| [a[0].min(b[0]), a[1].max(b[1])])?;
        let step = nice(((high - low) / 4.0).max(1.0));
        Some(Self {
            low: (low / step).floor() * step,
            high: (high / step).ceil() * step,
            step,
        })
    }

    fn width(self, dbm: f64) -> f64 {
        1.0 + 4.5 * ((dbm - self.low) / (self.high - self.low).max(self.step)).clamp(0.0, 1.0)
    }
}

fn draw(sheet: &mut Sheet, all: &[Map], least: f64, several: bool) {
    let places = all.iter().flat_map(|map| &map.net.places_m).copied();
    let panels = maps(sheet, bounds(&places.collect::<Vec<_>>()), all.len());
    let levels = Levels::of(all);
    for (at, map) in all.iter().enumerate() {
        let panel = &panels[at];
        axes(sheet, &panels, at);
        if let Some(ground) = &map.ground {
            ground.outlines(sheet, panel);
        }
        let dots: Vec<[f64; 2]> = (map.net.places_m.iter())
            .map(|[x, y]| panel.place(*x, *y))
            .collect();
        if let Some(levels) = levels {
            lines(sheet, &map.net.pairs, &dots, least, levels);
        }
        let radius = match (dots.len() > 100, all.len() > 1) {
            (false, false) => 5.5,
            (true, false) => 4.0,
            _ => 3.2,
        };
        for dot in &dots {
            sheet.disc(*dot, radius, NODE, 1.5);
        }
        if several && map.net.pairs.len() <= NUMBERS_MAX {
            numbers(sheet, &map.net.pairs, &dots, least);
        }
        if map.net.radios.len() <= NAMES_MAX / all.len() {
            names(sheet, panel, &map.net.radios, &dots, &map.net.pairs);
        }
        if map.net.pairs.is_empty() {
            let [left, top, ..] = panel.edges;
            let at = [left + 14.0, top + 24.0];
            sheet.words(at, "nobody heard anybody", SMALL, Anchor::Start, FAINT);
        }
        if all.len() > 1 {
            heading(sheet, panel, &format!("{}: {}", map.name, map.counted()));
        }
    }
    if let [panel] = panels.as_slice() {
        scale_bar(sheet, panel);
    }
    let [_, top, ..] = panels[0].edges;
    let foot = f64::from(sheet.height) - 40.0;
    let mut column = Column::at(f64::from(sheet.width), top + 12.0, foot);
    legend(sheet, &mut column, levels, several);
}

/// Half a line for each way, the best above the others.
fn lines(sheet: &mut Sheet, pairs: &[Pair], dots: &[[f64; 2]], least: f64, levels: Levels) {
    let alpha = if pairs.len() > 150 { 0.8 } else { 0.95 };
    let mut pairs: Vec<&Pair> = pairs.iter().collect();
    pairs.sort_by(|a, b| {
        let by_level = a.rssi_dbm().total_cmp(&b.rssi_dbm());
        a.ratio().total_cmp(&b.ratio()).then(by_level)
    });
    for pair in pairs {
        let [a, b] = pair.ends.map(|end| dots[end]);
        let middle = [0.5 * (a[0] + b[0]), 0.5 * (a[1] + b[1])];
        for (from, way) in [a, b].into_iter().zip(&pair.ways) {
            let line = vec![from, middle];
            if !is_drawn(way, least) {
                sheet.line(line, GRID, 1.0);
                continue;
            }
            let (ink, width) = (ramp(way.ratio).thin(alpha), levels.width(way.rssi_dbm));
            match way.half {
                Some(half) if half > UNSURE => sheet.dashed(line, ink, width, DASH),
                _ => sheet.line(line, ink, width),
            }
        }
    }
}

/// Dash and gap, pixels.
const DASH: [f64; 2] = [7.0, 5.0];

/// The delivery ratios of few links, each in the half that it is of.
fn numbers(sheet: &mut Sheet, pairs: &[Pair], dots: &[[f64; 2]], least: f64) {
    for pair in pairs {
        let [a, b] = pair.ends.map(|end| dots[end]);
        for (share, way) in [0.27, 0.73].into_iter().zip(&pair.ways) {
            let at = [0, 1].map(|k| a[k] + share * (b[k] - a[k]));
            if !is_drawn(way, least) {
                continue;
            }
            let text = match way.half {
                Some(half) => format!("{:.2} \u{b1} {half:.2}", way.ratio),
                None => format!("{:.2}", way.ratio),
            };
            sheet.words_apart([at[0], at[1] + 4.0], &text, 12.0, Anchor::Middle);
        }
    }
}

/// West, south, east, north of all radios, m.
fn bounds(places: &[[f64; 2]]) -> [f64; 4] {
    let ends = |k: usize| {
        let along = || places.iter().map(|place| place[k]);
        let low = along().fold(f64::INFINITY, f64::min);
        [low, along().fold(f64::NEG_INFINITY, f64::max)]
    };
    let [[west, east], [south, north]] = [ends(0), ends(1)];
    [west, south, east, north]
}

/// Names of the radios, each where it hides least.
fn names(sheet: &mut Sheet, panel: &Panel, radios: &[String], dots: &[[f64; 2]], pairs: &[Pair]) {
    let owner = |radio: &str| {
        radio
            .rsplit_once('/')
            .map_or(radio, |(owner, _)| owner)
            .to_owned()
    };
    let owners: Vec<String> = radios.iter().map(|radio| owner(radio)).collect();
    let size = if radios.len() > 30 { 12.0 } else { SMALL };
    let mut names = Names::around(panel.edges, dots.iter().copied());
    for (at, [x, y]) in dots.iter().enumerate() {
        let alone = owners.iter().filter(|other| **other == owners[at]).count() == 1;
        let text = if alone { &owners[at] } else { &radios[at] };
        // Where other links come from is crowded.
        let crowd = |dx: f64, dy: f64| -> f64 {
            let mine = pairs.iter().filter(|pair| pair.ends.contains(&at));
            let towards = mine.map(|pair| {
                let other = dots[pair.ends[usize::from(pair.ends[0] == at)]];
                let (ex, ey) = (other[0] - x, other[1] - y);
                let cosine = (ex * dx + ey * dy) / ((ex * ex + ey * ey).sqrt() + 1e-9);
                (cosine - 0.5).max(0.0)
            });
            towards.sum()
        };
        names.write(sheet, [*x, *y], text, size, crowd);
    }
}

fn legend(sheet: &mut Sheet, column: &mut Column, levels: Option<Levels>, several: bool) {
    column.colours(sheet, "delivery ratio", [0.0, 1.0], ramp);
    if let Some(levels) = levels {
        column.say(sheet, "RSSI, dBm", super::sheet::TEXT);
        let mut level = levels.high;
        while level >= levels.low - 0.5 * levels.step {
            let text = number(level, levels.step);
            column.line(sheet, ramp(0.85), levels.width(level), &text);
            level -= levels.step;
        }
        column.gap();
    }
    if several {
        column.dashes(sheet, ramp(0.85), &format!("\u{b1} more than {UNSURE}"));
        column.note(sheet, &["with 95 % confidence"]);
        column.gap();
    }
    let how = [
        "Each half of a line is",
        "of the frames from its",
        "end, as the other end",
        "receives them; grey:",
        "none of them.",
    ];
    if column.room() >= how.len() {
        column.note(sheet, &how);
    }
}
