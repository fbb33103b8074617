//! The base, which gathers what is declared, and the referee, who knows the truth.

use super::words::Word;
use simbeeotic::prelude::*;
use simbeeotic::units::glam::{DVec2, DVec3};
use std::collections::BTreeMap;

/// A station that listens for declarations, and calls everybody home when enough of them agree: the
/// leak is where they are in the mean. It publishes `declarations`, `time-to-first` and `time-to-found`.
#[behavior("plume-base", host = Station)]
pub struct Base {
    params: BaseParams,
    radio: RadioHandle,
    /// By who declared.
    declared: BTreeMap<ModelId, DVec2>,
    found: bool,
}

/// Parameters of [`Base`].
#[params]
pub struct BaseParams {
    /// How many declarations have to agree, 1 to 100.
    pub quorum: u32,
    /// They agree that are within this of their median.
    pub agree: Length,
    /// The path of a model that is told what is declared and found: a referee. Without it nobody.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub referee: Option<String>,
}

impl Default for BaseParams {
    fn default() -> Self {
        Self {
            quorum: 3,
            agree: Length::si(8.0),
            referee: None,
        }
    }
}

/// What the base tells the referee.
#[derive(Clone, Copy, Debug)]
enum Claim {
    /// One vehicle says that the leak is here.
    Declared(DVec2),
    /// The base does.
    Found(DVec2),
}

impl Behavior<Station> for Base {
    type Params = BaseParams;

    fn build(params: BaseParams, kit: &mut Kit<Self, Station>) -> Result<Self, BuildError> {
        in_range("quorum", params.quorum, 1..=100)?;
        positive("agree", params.agree)?;
        kit.every(Time::from_secs(2.0), Self::call_home);
        Ok(Self {
            params,
            radio: kit.radio()?,
            declared: BTreeMap::new(),
            found: false,
        })
    }

    fn body(_params: &BaseParams) -> Option<BodySpec> {
        let half_m = DVec3::new(0.5, 0.5, 0.25);
        Some(BodySpec {
            p_enu: DVec3::new(0.0, 0.0, half_m.z),
            mobility: Mobility::Fixed,
            group: group::HIVE,
            kind: Some(Kind::Station),
            ..BodySpec::new(Shape::Box { half_m }, 1.0)
        })
    }

    fn on_packet(&mut self, packet: &Packet<'_>, base: &mut Platform<'_>) {
        let Some(Word::Declared(place)) = Word::decode(packet.payload()) else {
            return;
        };
        if self.declared.insert(packet.sender(), place) == Some(place) {
            return; // said again
        }
        let (count, now_s) = (self.declared.len(), base.now().as_secs_f64());
        base.metric("declarations", count as f64, "1");
        if count == 1 {
            base.metric("time-to-first", now_s, "s");
        }
        self.tell(Claim::Declared(place), base);
        if let Some(place) = self.agreed().filter(|_| !self.found) {
            self.found = true;
            base.metric("time-to-found", now_s, "s");
            base.log(format!("the leak is at {:.1} m, {:.1} m", place.x, place.y));
            self.tell(Claim::Found(place), base);
            self.call_home(base);
        }
    }
}

impl Base {
    fn call_home(&mut self, base: &mut Platform<'_>) {
        if self.found {
            base.send(self.radio, &Word::Found.encode());
        }
    }

    /// The mean of those declarations that agree, if they are enough.
    fn agreed(&self) -> Option<DVec2> {
        let median = |of: fn(&DVec2) -> f64| {
            let mut all: Vec<f64> = self.declared.values().map(of).collect();
            all.sort_by(f64::total_cmp);
            all[all.len() / 2]
        };
        if self.declared.is_empty() {
            return None;
        }
        let middle = DVec2::new(median(|p| p.x), median(|p| p.y));
        let near = |p: &&DVec2| p.distance(middle) <= self.params.agree.metres();
        let agree: Vec<DVec2> = self.declared.values().filter(near).copied().collect();
        let mean = agree.iter().sum::<DVec2>() / agree.len() as f64;
        (agree.len() >= self.params.quorum as usize).then_some(mean)
    }

    fn tell(&self, claim: Claim, base: &mut Platform<'_>) {
        let Some(path) = self.params.referee.as_deref() else {
            return;
        };
        match base.find(path) {
            Some(referee) => base.tell(referee, claim),
            None => base.fault(format!("no model is called {path:?}, its `referee`")),
        }
    }
}

/// Holds what is claimed against the world's first source: `first-error` of the first declaration,
/// `source-error` of what the base says. It takes no part.
#[behavior("plume-referee", host = Bodiless)]
pub struct Referee {
    first: bool,
}

/// It has none.
#[params]
#[derive(Default)]
pub struct RefereeParams {}

impl Behavior<Bodiless> for Referee {
    type Params = RefereeParams;

    fn build(_: RefereeParams, _: &mut Kit<Self, Bodiless>) -> Result<Self, BuildError> {
        Ok(Self { first: true })
    }

    fn on_message(&mut self, message: &Message, cx: &mut Cx<'_>) {
        let Some(leak) = cx.world().sources.first().map(|s| s.position.si()) else {
            return;
        };
        match message.get::<Claim>() {
            Some(Claim::Declared(place)) if self.first => {
                self.first = false;
                cx.metric("first-error", place.distance(leak.truncate()), "m");
            }
            Some(Claim::Found(place)) => {
                cx.metric("source-error", place.distance(leak.truncate()), "m");
            }
            _ => {}
        }
    }
}
