//! Measured gains of links from a table: a real deployment replayed.

use super::free_space::FreeSpace;
use super::{Link, Links, Propagation, Role};
use crate::table::{TableFault, cells, lines};
use simbeeotic_kernel::SimTime;
use simbeeotic_kernel::rng::path_key;
use simbeeotic_units::{Decibels, did_you_mean};
use std::collections::{BTreeMap, BTreeSet};
use std::fmt;

/// The gains of links as they were measured, by the names of their ends; where the ends are does not matter.
///
/// # The file
///
/// ```text
/// # a comment
/// tx, rx, loss_db, time_s
/// bee-0, bee-1, 71.5, 0
/// bee-1/radio, bee-0, 73, 0
/// bee-0, bee-1, 90, 12.5
/// ```
/// The header names the columns, in any order: `tx` and `rx`, one of `gain_db` and `loss_db`, and `time_s` if
/// gains change. A name is the path of a model, which stands for its radio called `radio`, or that of a radio.
/// Losses are 0 to 300 dB, antennas not included. A gain holds from its time to the next of its link, the first
/// from the start.
#[derive(Clone, PartialEq)]
pub struct LinkTable {
    names: Vec<String>,
    /// Line and column where each name stands first.
    places: Vec<(usize, usize)>,
    /// Keys of radios with the index of their name, by key.
    ends: Vec<(u64, u32)>,
    /// Sender, receiver, and where the series begins and ends, by sender and receiver.
    links: Vec<([u32; 2], [u32; 2])>,
    series: Vec<Sample>,
    missing: MissingLink,
}

/// What becomes of a link that is not in a [`LinkTable`].
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum MissingLink {
    /// Nothing comes through.
    #[default]
    Lost,
    /// It is one of free space.
    FreeSpace,
}

#[derive(Clone, Copy, Debug, PartialEq)]
struct Sample {
    from: SimTime,
    loss_db: f64,
    gain: f32,
}

/// For so many names that no radio has, the nearest is looked for.
const GUESSES_MAX: usize = 20;

/// Times later than this are not read, seconds: 31 years.
const TIME_S_MAX: f64 = 1e9;

impl fmt::Debug for LinkTable {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(
            f,
            "a table of {} links of {} radios",
            self.links.len(),
            self.names.len()
        )
    }
}

impl LinkTable {
    /// The table in a text. `symmetric`: each row holds in both directions.
    ///
    /// # Errors
    /// All lines that make no sense, with their places.
    pub fn read(
        text: &str,
        symmetric: bool,
        missing: MissingLink,
    ) -> Result<Self, Vec<TableFault>> {
        let mut reader = Reader {
            faults: Vec::new(),
            names: BTreeMap::new(),
            places: Vec::new(),
            rows: BTreeMap::new(),
            symmetric,
        };
        reader.read(text);
        if reader.faults.is_empty() {
            Ok(Self::new(reader, missing))
        } else {
            Err(reader.faults)
        }
    }

    fn new(reader: Reader<'_>, missing: MissingLink) -> Self {
        let mut names = vec![String::new(); reader.names.len()];
        let mut ends = BTreeSet::new();
        for (name, index) in &reader.names {
            names[*index as usize] = (*name).to_owned();
            ends.insert((path_key(name), *index));
            ends.insert((path_key(&format!("{name}/radio")), *index));
        }
        let (mut links, mut series) = (Vec::<([u32; 2], [u32; 2])>::new(), Vec::new());
        for (&(tx, rx, from), &loss_db) in &reader.rows {
            let at = series.len() as u32;
            match links.last_mut() {
                Some((ends, range)) if *ends == [tx, rx] => range[1] = at + 1,
                _ => links.push(([tx, rx], [at, at + 1])),
            }
            series.push(Sample {
                from,
                loss_db,
                gain: Decibels::from_db(-loss_db).ratio() as f32,
            });
        }
        Self {
            names,
            places: reader.places,
            ends: ends.into_iter().collect(),
            links,
            series,
            missing,
        }
    }

    /// The names in the table, in the order in which they came.
    pub fn names(&self) -> &[String] {
        &self.names
    }

    /// The table beside the radios of a scenario, given by their paths (`bee-0/radio`): the names that no
    /// radio has, each at its first place, and whether there is a link between two radios that exist.
    pub fn compare(&self, radios: impl Iterator<Item = String>) -> (Vec<TableFault>, bool) {
        let radios: BTreeSet<String> = radios.collect();
        let here =
            |name: &String| radios.contains(name) || radios.contains(&format!("{name}/radio"));
        let known: Vec<bool> = self.names.iter().map(here).collect();
        let connects = self
            .links
            .iter()
            .any(|([tx, rx], _)| known[*tx as usize] && known[*rx as usize]);
        let mut strangers = Vec::new();
        for ((name, known), (line, column)) in self.names.iter().zip(known).zip(&self.places) {
            if known {
                continue;
            }
            let paths = radios.iter().map(String::as_str);
            let short = paths.map(|path| path.strip_suffix("/radio").unwrap_or(path));
            // Guesses cost a look at each radio.
            let guess = (strangers.len() < GUESSES_MAX)
                .then(|| did_you_mean(name, short))
                .flatten();
            let guess = guess.map(|guess| format!("; did you mean `{guess}`?"));
            strangers.push(TableFault::new(
                *line,
                *column,
                format!("no radio is called `{name}`{}", guess.unwrap_or_default()),
            ));
        }
        (strangers, connects)
    }

    fn end(&self, key: u64) -> Option<u32> {
        let at = self.ends.partition_point(|end| end.0 < key);
        let end = self.ends.get(at)?;
        (end.0 == key).then_some(end.1)
    }

    fn sample(&self, tx: u32, rx: u32, time: SimTime) -> Option<&Sample> {
        let at = self.links.partition_point(|link| link.0 < [tx, rx]);
        let (ends, [first, last]) = self.links.get(at)?;
        if *ends != [tx, rx] {
            return None;
        }
        let series = &self.series[*first as usize..*last as usize];
        let begun = series.partition_point(|sample| sample.from <= time);
        series.get(begun.saturating_sub(1))
    }
}

impl Propagation for LinkTable {
    fn loss(&self, link: &Link) -> Decibels {
        let ends = self.end(link.tx.key).zip(self.end(link.rx.key));
        match ends.and_then(|(tx, rx)| self.sample(tx, rx, link.time)) {
            Some(sample) => Decibels::from_db(sample.loss_db),
            None => match self.missing {
                MissingLink::Lost => Decibels::from_db(f64::INFINITY),
                MissingLink::FreeSpace => FreeSpace.loss(link),
            },
        }
    }

    fn gains(&self, links: &Links<'_>, gains: &mut [f32]) {
        match self.missing {
            MissingLink::Lost => gains.fill(0.0),
            MissingLink::FreeSpace => FreeSpace.gains(links, gains),
        }
        let Some(near) = self.end(links.near_key) else {
            return;
        };
        for (gain, &key) in gains.iter_mut().zip(links.far_keys) {
            let sample = self.end(key).and_then(|far| match links.near_is {
                Role::Transmitter => self.sample(near, far, links.time),
                Role::Receiver => self.sample(far, near, links.time),
            });
            if let Some(sample) = sample {
                *gain = sample.gain;
            }
        }
    }
}

/// What a column is.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Column {
    Tx,
    Rx,
    Gain,
    Loss,
    Time,
}

const COLUMNS: [(&str, Column); 5] = [
    ("tx", Column::Tx),
    ("rx", Column::Rx),
    ("gain_db", Column::Gain),
    ("loss_db", Column::Loss),
    ("time_s", Column::Time),
];

struct Reader<'t> {
    faults: Vec<TableFault>,
    names: BTreeMap<&'t str, u32>,
    places: Vec<(usize, usize)>,
    /// Losses by sender, receiver, time.
    rows: BTreeMap<(u32, u32, SimTime), f64>,
    symmetric: bool,
}

impl<'t> Reader<'t> {
    fn fault(&mut self, line: usize, column: usize, message: impl Into<String>) {
        self.faults.push(TableFault::new(line, column, message));
    }

    fn read(&mut self, text: &'t str) {
        let mut lines = lines(text);
        let Some((at, header)) = lines.next() else {
            return self.fault(1, 1, "the header is missing: tx, rx, gain_db");
        };
        let Some(columns) = self.header(at, header) else {
            return;
        };
        for (at, line) in lines {
            let cells: Vec<_> = cells(line).collect();
            self.row(at, &cells, &columns);
        }
        if self.rows.is_empty() && self.faults.is_empty() {
            self.fault(at, 1, "there are no links below the header");
        }
    }

    fn header(&mut self, line: usize, header: &str) -> Option<Vec<Column>> {
        let mut columns = Vec::new();
        for (at, word) in cells(header) {
            let Some((_, column)) = COLUMNS.iter().find(|(name, _)| *name == word) else {
                let names = COLUMNS.map(|(name, _)| name);
                let guess =
                    did_you_mean(word, names).map(|name| format!("; did you mean `{name}`?"));
                let guess = guess.unwrap_or_default();
                let all = names.join(", ");
                self.fault(
                    line,
                    at,
                    format!("unknown column `{word}`{guess} (columns: {all})"),
                );
                continue;
            };
            if columns.contains(column) {
                self.fault(line, at, format!("a second column `{word}`"));
            }
            columns.push(*column);
        }
        if !self.faults.is_empty() {
            return None;
        }
        for (name, column) in [("tx", Column::Tx), ("rx", Column::Rx)] {
            if !columns.contains(&column) {
                self.fault(line, 1, format!("the column `{name}` is missing"));
            }
        }
        match (
            columns.contains(&Column::Gain),
            columns.contains(&Column::Loss),
        ) {
            (false, false) => self.fault(line, 1, "a column `gain_db` or `loss_db` is missing"),
            (true, true) => {
                self.fault(line, 1, "`gain_db` and `loss_db` say the same: one will do")
            }
            _ => {}
        }
        self.faults.is_empty().then_some(columns)
    }

    fn row(&mut self, line: usize, fields: &[(usize, &'t str)], columns: &[Column]) {
        if fields.len() != columns.len() {
            let message = format!(
                "{} fields, and the header has {}",
                fields.len(),
                columns.len()
            );
            return self.fault(line, 1, message);
        }
        let before = self.faults.len();
        let (mut tx, mut rx, mut loss_db, mut time) = ((1, 0), (1, 0), 0.0, SimTime::ZERO);
        for (&(at, field), column) in fields.iter().zip(columns) {
            match column {
                Column::Tx => tx = (at, self.name(line, at, field)),
                Column::Rx => rx = (at, self.name(line, at, field)),
                Column::Loss => loss_db = self.loss(line, at, field, 1.0),
                Column::Gain => loss_db = self.loss(line, at, field, -1.0),
                Column::Time => time = self.time(line, at, field),
            }
        }
        if self.faults.len() > before {
            return;
        }
        if tx.1 == rx.1 {
            return self.fault(
                line,
                rx.0,
                "a radio does not hear itself: `tx` and `rx` are one",
            );
        }
        let mut twice = self.rows.insert((tx.1, rx.1, time), loss_db).is_some();
        if self.symmetric {
            twice |= self.rows.insert((rx.1, tx.1, time), loss_db).is_some();
        }
        if twice {
            let also = if self.symmetric {
                "; with `symmetric` each row holds both ways"
            } else {
                ""
            };
            self.fault(
                line,
                tx.0,
                format!("this link has a gain for this time already{also}"),
            );
        }
    }

    fn name(&mut self, line: usize, column: usize, name: &'t str) -> u32 {
        // The radio of a model that has one is called `radio`: two names for one end.
        let short = name.strip_suffix("/radio").unwrap_or(name);
        if short.is_empty() {
            self.fault(line, column, "the name is missing");
        }
        let next = self.names.len() as u32;
        let index = *self.names.entry(short).or_insert(next);
        if index == next {
            self.places.push((line, column));
        }
        index
    }

    fn number(&mut self, line: usize, column: usize, field: &str) -> Option<f64> {
        match field.parse::<f64>() {
            Ok(number) if number.is_finite() => Some(number),
            _ => {
                self.fault(line, column, format!("`{field}` is no number"));
                None
            }
        }
    }

    fn loss(&mut self, line: usize, column: usize, field: &str, sign: f64) -> f64 {
        let Some(number) = self.number(line, column, field) else {
            return 0.0;
        };
        let loss_db = sign * number;
        if !(0.0..=super::LOSS_DB_MAX).contains(&loss_db) {
            let range = if sign > 0.0 {
                "a loss is 0 dB to 300 dB"
            } else {
                "a gain is -300 dB to 0 dB"
            };
            self.fault(line, column, format!("{range}, and this is {field}"));
        }
        loss_db + 0.0
    }

    fn time(&mut self, line: usize, column: usize, field: &str) -> SimTime {
        let Some(seconds) = self.number(line, column, field) else {
            return SimTime::ZERO;
        };
        if !(0.0..=TIME_S_MAX).contains(&seconds) {
            self.fault(
                line,
                column,
                format!("a time is 0 s to {TIME_S_MAX:e} s, and this is {field}"),
            );
            return SimTime::ZERO;
        }
        SimTime::from_nanos((seconds * 1e9).round() as u64)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::propagation::FrameKeys;
    use crate::propagation::testing::{CHANNEL, between};
    use glam::DVec3;

    fn link(tx: &str, rx: &str, seconds: u64) -> Link {
        let mut link = between(DVec3::ZERO, DVec3::X * 10.0);
        (link.tx.key, link.rx.key) = (path_key(tx), path_key(rx));
        link.time = SimTime::from_secs(seconds);
        link
    }

    fn table(text: &str) -> LinkTable {
        LinkTable::read(text, false, MissingLink::Lost).expect("a good table")
    }

    fn faults(text: &str) -> Vec<String> {
        let faults = LinkTable::read(text, false, MissingLink::Lost).expect_err("a bad table");
        faults.iter().map(ToString::to_string).collect()
    }

    const TEXT: &str = "# measured\n tx , rx,loss_db, time_s\n\nbee-0,bee-1,71.5,0\n\
                        bee-1/radio,bee-0, 73,0\nbee-0,bee-1,90,12\nbee-2/up, bee-0, 80, 3\n";

    #[test]
    fn directions_times_and_both_kinds_of_names_are_told_apart() {
        let table = table(TEXT);
        let loss = |tx, rx, s| table.loss(&link(tx, rx, s)).db();
        assert_eq!(loss("bee-0/radio", "bee-1/radio", 0), 71.5);
        assert_eq!(loss("bee-1/radio", "bee-0/radio", 0), 73.0);
        assert_eq!(loss("bee-0/radio", "bee-1/radio", 11), 71.5);
        assert_eq!(loss("bee-0/radio", "bee-1/radio", 12), 90.0);
        assert_eq!(
            loss("bee-2/up", "bee-0/radio", 0),
            80.0,
            "the first holds from the start"
        );
        assert_eq!(loss("bee-2/radio", "bee-0/radio", 0), f64::INFINITY);
        assert_eq!(loss("bee-0/radio", "bee-2/up", 0), f64::INFINITY);
        assert_eq!(table.names(), ["bee-0", "bee-1", "bee-2/up"]);
    }

    #[test]
    fn names_that_no_radio_has_are_told_with_their_place_and_the_nearest() {
        let radios = |names: &[&str]| names.iter().map(|s| (*s).to_owned()).collect::<Vec<_>>();
        let told = |names: &[&str]| {
            let (strangers, connects) = table(TEXT).compare(radios(names).into_iter());
            let lines: Vec<String> = strangers.iter().map(ToString::to_string).collect();
            (lines, connects)
        };
        let all = ["bee-0/radio", "bee-1/radio", "bee-2/up", "bee-3/radio"];
        assert_eq!(told(&all), (vec![], true));
        let (lines, connects) = told(&["bee-0/radio", "bee-1/radio", "bee-2/radio"]);
        assert_eq!(lines.len(), 1);
        assert!(
            lines[0].starts_with("7:1: no radio is called `bee-2/up`"),
            "{lines:?}"
        );
        assert!(connects);
        let (lines, connects) = told(&["Bee_0/radio", "other/radio"]);
        assert_eq!(lines.len(), 3);
        assert_eq!(
            lines[0],
            "4:1: no radio is called `bee-0`; did you mean `Bee_0`?"
        );
        assert!(
            lines[1].starts_with("4:7: no radio is called `bee-1`"),
            "{lines:?}"
        );
        assert!(!connects);
        // Both ends are there, and no link between them.
        let (lines, connects) = told(&["bee-1/radio", "bee-2/up"]);
        assert_eq!((lines.len(), connects), (1, false));
    }

    #[test]
    fn missing_links_are_lost_or_of_free_space() {
        let open = LinkTable::read(TEXT, false, MissingLink::FreeSpace).expect("good");
        let missing = link("bee-7/radio", "bee-0/radio", 0);
        assert_eq!(open.loss(&missing), FreeSpace.loss(&missing));
        let both =
            LinkTable::read("tx,rx,gain_db\na,b,-60\n", true, MissingLink::Lost).expect("good");
        assert_eq!(both.loss(&link("a/radio", "b/radio", 0)).db(), 60.0);
        assert_eq!(both.loss(&link("b/radio", "a/radio", 5)).db(), 60.0);
    }

    #[test]
    fn rows_agree_with_single_links_in_either_role() {
        let keys = ["bee-0/radio", "bee-1/radio", "bee-2/up", "nobody"].map(path_key);
        for missing in [MissingLink::Lost, MissingLink::FreeSpace] {
            let table = LinkTable::read(TEXT, false, missing).expect("good");
            for near_is in [Role::Transmitter, Role::Receiver] {
                for near_key in keys {
                    let far = [[1.0f32, 20.0, 300.0, 40.0], [0.0; 4], [0.0; 4]];
                    let links = Links {
                        frequency: CHANNEL,
                        time: SimTime::from_secs(13),
                        near_is,
                        near_enu_m: [0.0; 3],
                        near_key,
                        far_enu_m: [&far[0], &far[1], &far[2]],
                        far_keys: &keys,
                        distances_squared_m2: &far[0].map(|x| x * x),
                        frames: FrameKeys::One(1),
                    };
                    let mut gains = [9.0; 4];
                    table.gains(&links, &mut gains);
                    for (j, gain) in gains.into_iter().enumerate() {
                        let exact = (-table.loss(&links.link(j))).ratio();
                        assert!(
                            (f64::from(gain) - exact).abs() <= 1e-4 * exact,
                            "{gain}, {exact}"
                        );
                    }
                }
            }
        }
    }

    #[test]
    fn each_bad_line_has_its_place_and_what_was_meant() {
        assert_eq!(
            faults("tx,rx,los_db\na,b,3\n"),
            [
                "1:7: unknown column `los_db`; did you mean `loss_db`? (columns: tx, rx, gain_db, loss_db, time_s)"
            ]
        );
        assert_eq!(faults(""), ["1:1: the header is missing: tx, rx, gain_db"]);
        assert_eq!(
            faults("tx,rx\na,b\n"),
            ["1:1: a column `gain_db` or `loss_db` is missing"]
        );
        assert_eq!(
            faults(
                "tx,rx,gain_db,time_s\na,b,-60\na, b, x, 0\na,a,-60,0\na,b,60,0\n,b,-60,-1\na,b,-60,0\na,b,-60,0"
            ),
            [
                "2:1: 3 fields, and the header has 4",
                "3:7: `x` is no number",
                "4:3: a radio does not hear itself: `tx` and `rx` are one",
                "5:5: a gain is -300 dB to 0 dB, and this is 60",
                "6:1: the name is missing",
                "6:8: a time is 0 s to 1e9 s, and this is -1",
                "8:1: this link has a gain for this time already",
            ]
        );
    }
}
