//! Measured gains of links from a file.

use crate::table::{TableFile, placed};
use simbeeotic_model::radio::{Link, LinkTable, Links, MissingLink, Propagation, Remark};
use simbeeotic_model::units::Decibels;
use simbeeotic_model::{BuildError, FromParams, Site, choice, params, propagation};

/// The gains of links as they were measured: a real deployment replayed. Where the ends are does not matter.
///
/// The file has lines of `tx, rx, loss_db` (or `gain_db`) below a header that names the columns, and
/// `time_s` where gains change: a gain holds until the next of its link. Names are paths: `bee-3`, which
/// stands for its radio called `radio`, or `bee-3/long`. Losses are 0 dB to 300 dB, antennas not included.
/// Lines that start with `#` are skipped. `range_limit` counts as ever: set it to more than the longest
/// distance.
#[propagation("link-table")]
#[derive(Debug)]
pub struct LinkTablePropagation {
    table: LinkTable,
    /// The file's name, for messages.
    file: String,
}

/// What becomes of a link that is not in the file.
#[choice]
pub enum Missing {
    /// Nothing comes through.
    Lost,
    /// It is one of free space.
    FreeSpace,
}

/// Parameters of [`LinkTablePropagation`].
#[params]
pub struct LinkTableParams {
    /// The file, beside the scenario.
    pub file: String,
    /// Whether each line holds in both directions.
    pub symmetric: bool,
    /// What becomes of a link that is not in the file.
    pub missing: Missing,
}

impl Default for LinkTableParams {
    fn default() -> Self {
        Self {
            file: String::new(),
            symmetric: false,
            missing: Missing::Lost,
        }
    }
}

impl FromParams for LinkTablePropagation {
    type Params = LinkTableParams;

    fn from_params(params: LinkTableParams) -> Result<Self, BuildError> {
        Self::for_run(params, &Site::default())
    }

    fn for_run(params: LinkTableParams, site: &Site<'_>) -> Result<Self, BuildError> {
        let file = TableFile::read(site, &params.file, "tx, rx and gain_db or loss_db")?;
        let missing = match params.missing {
            Missing::Lost => MissingLink::Lost,
            Missing::FreeSpace => MissingLink::FreeSpace,
        };
        let table = LinkTable::read(&file.text, params.symmetric, missing)
            .map_err(|faults| file.refused(&faults))?;
        let file = file.name;
        Ok(Self { table, file })
    }
}

impl Propagation for LinkTablePropagation {
    fn loss(&self, link: &Link) -> Decibels {
        self.table.loss(link)
    }

    fn gains(&self, links: &Links<'_>, gains: &mut [f32]) {
        self.table.gains(links, gains);
    }

    fn remarks(&self, radios: &mut dyn Iterator<Item = String>) -> Vec<Remark> {
        let (strangers, connects) = self.table.compare(radios);
        let mut remarks = Vec::new();
        if !strangers.is_empty() {
            remarks.push(Remark {
                key: "file",
                fatal: false,
                message: format!(
                    "has names that no radio has: {}",
                    placed(&self.file, &strangers)
                ),
            });
        }
        if !connects {
            remarks.push(Remark {
                key: "file",
                fatal: true,
                message: format!("none of the links in {} is between two radios", self.file),
            });
        }
        remarks
    }
}
