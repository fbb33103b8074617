//! What the paper's section 5.1 says in numbers.
//!
//! Its goal is a thousand MAVs at the typical workload, which is that of figure 7. Its curves are in pictures only, and their scales are not in its text: of figure 7 and 8 one point each
//! is known, the size above which real time was lost; of figure 6 none. Nothing else is drawn, since it would
//! be made up.

/// What is known of one of the paper's figures.
#[derive(Clone, Copy)]
pub(super) struct Paper {
    /// The size above which soft real time could not be kept.
    pub(super) limit: Option<u32>,
    /// The size that the paper set itself as its goal, in soft real time or better.
    pub(super) goal: Option<u32>,
    /// What its text says, short.
    pub(super) says: &'static str,
}

/// Virtual time of the paper's runs, s.
pub(super) const DURATION_S: f64 = 100.0;

/// On what it was measured.
pub(super) const CPU: &str = "2.2 GHz quad-core laptop, 8 GB";

/// Where it says so.
pub(super) const SOURCE: &str = "IPSN 2012, section 5.1 and the captions of its figures";

/// With what.
pub(super) const VERSION: &str = "Simbeeotic (Java), HotSpot 1.6.0_26";

pub(super) const FIG6: Paper = Paper {
    limit: None,
    goal: None,
    says: "event time constant, physics time linear in the obstacles; no numbers",
};

pub(super) const FIG7: Paper = Paper {
    limit: Some(3_074),
    goal: Some(1_000),
    says: "3,074 MAVs in soft real time; its goal was one thousand",
};

pub(super) const FIG8: Paper = Paper {
    limit: Some(550),
    goal: None,
    says: "550 MAVs in soft real time",
};
