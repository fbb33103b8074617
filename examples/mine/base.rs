//! The base at the foot of the shaft: it hears what vehicles have found, and passes it on.

use super::chart::Chart;
use super::finds::Finds;
use super::referee::Report;
use simbeeotic::prelude::*;

/// A small box with a radio at the foot of the shaft.
///
/// It takes over the charts and finds that vehicles tell, and broadcasts its own. It publishes how many
/// cells it knows that somebody was in, `cells-explored`, and how many people it has been told of, `reports`; a model called
/// `referee` is told where these are said to be.
#[behavior("mine-base", host = Station)]
pub struct MineBase {
    radio: RadioHandle,
    chart: Chart,
    finds: Finds,
    told: usize,
}

/// Parameters of [`MineBase`].
#[params]
pub struct MineBaseParams {
    /// Time between two broadcasts.
    pub period: Time,
}

impl Default for MineBaseParams {
    fn default() -> Self {
        Self {
            period: Time::from_millis(500.0),
        }
    }
}

impl Behavior<Station> for MineBase {
    type Params = MineBaseParams;

    fn build(params: MineBaseParams, kit: &mut Kit<Self, Station>) -> Result<Self, BuildError> {
        kit.every(params.period, Self::talk);
        Ok(Self {
            radio: kit.radio()?,
            chart: Chart::default(),
            finds: Finds::default(),
            told: 0,
        })
    }

    fn body(_: &MineBaseParams) -> Option<BodySpec> {
        let ball = BodySpec::new(Shape::Sphere { radius_m: 0.1 }, 1.0);
        Some(BodySpec {
            mobility: Mobility::Fixed,
            ..ball
        })
    }

    fn on_packet(&mut self, packet: &Packet<'_>, base: &mut Platform<'_>) {
        self.chart.hear(packet.payload());
        self.finds.hear(packet.payload());
        let sure = self.finds.sure().count();
        if sure > self.told {
            self.told = sure;
            base.metric("reports", sure as f64, "1");
            if let Some(referee) = base.find("referee") {
                base.tell(referee, Report(self.finds.sure().collect()));
            }
        }
    }

    fn on_finish(&mut self, base: &mut Platform<'_>) {
        base.metric("cells-explored", self.chart.visited() as f64, "1");
    }
}

impl MineBase {
    fn talk(&mut self, base: &mut Platform<'_>) {
        base.metric("cells-explored", self.chart.visited() as f64, "1");
        let chart = self.chart.packet();
        base.send(self.radio, &chart);
        if let Some(finds) = self.finds.packet() {
            base.send(self.radio, &finds);
        }
    }
}
