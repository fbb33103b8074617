//! What pages are told about a selected vehicle.

use crate::wire::{
    BatteryDetails, BeamsDetails, Details, MountDetails, PacketDetails, Part, RadioDetails,
    SensorDetails,
};
use simbeeotic_model::kernel::{ModelId, SimTime};
use simbeeotic_model::radio::{Channel, Loss, RadioState};
use simbeeotic_model::units::Mount;
use simbeeotic_model::{About, AboutRadio, Beams, Condition, Taken, View};
use std::collections::BTreeMap;

/// A vehicle that a page has selected.
pub(super) struct Selected {
    id: ModelId,
    about: About,
    /// The last reading of each sensor.
    readings: BTreeMap<u16, (SimTime, Taken)>,
}

impl Selected {
    pub(super) fn new(view: &View<'_>, id: ModelId) -> Self {
        Self {
            id,
            about: view.about(id),
            readings: BTreeMap::new(),
        }
    }

    /// A sensor has measured. Pictures are not kept.
    pub(super) fn sensed(&mut self, time: SimTime, sensor: u16, taken: &Taken) {
        let taken = Taken {
            columns: taken.columns,
            paired: taken.paired,
            ideal: taken.ideal.clone(),
            reading: taken.reading.clone(),
            ideal_images: Vec::new(),
            images: Vec::new(),
            lost: taken.lost,
        };
        self.readings.insert(sensor, (time, taken));
    }

    /// All there is to tell now.
    pub(super) fn tell(
        &self,
        view: &View<'_>,
        vehicle: u32,
        packets: Vec<PacketDetails>,
    ) -> Details {
        let sensors = self.about.sensors.iter().enumerate();
        let sensors = sensors.map(|(at, sensor)| {
            let last = u16::try_from(at).ok().and_then(|at| self.readings.get(&at));
            let mut details = SensorDetails {
                name: sensor.name.clone(),
                mount: mount(&sensor.mount),
                beams: sensor.beams.as_ref().map(beams),
                ..SensorDetails::default()
            };
            if let Some((time, taken)) = last {
                details.t = Some(time.as_secs_f64());
                let columns = taken.columns.iter();
                details.columns = columns
                    .map(|column| (column.name.to_owned(), column.unit.to_owned()))
                    .collect();
                details.reading = (!taken.reading.is_empty()).then(|| taken.reading.clone());
                details.truth = Some(taken.ideal.clone());
                details.lost = taken.lost;
            }
            details
        });
        let parts = self.about.parts.iter().map(|part| Part {
            place: part.place.clone(),
            name: part.name.clone(),
            parameters: part.parameters.clone(),
        });
        Details {
            vehicle,
            t: view.now().as_secs_f64(),
            parts: parts.collect(),
            sensors: sensors.collect(),
            battery: battery(view, self.id),
            radios: (self.about.radios.iter())
                .map(|radio_of| radio(view, radio_of))
                .collect(),
            packets,
        }
    }
}

fn battery(view: &View<'_>, id: ModelId) -> Option<BatteryDetails> {
    let state = view.battery(id)?;
    let condition = match state.condition {
        Condition::Fit if state.on_charger => "charging".to_owned(),
        Condition::Fit => "fit".to_owned(),
        other => format!("{other:?}").to_lowercase(),
    };
    Some(BatteryDetails {
        soc: state.soc,
        voltage_v: state.voltage.get(),
        current_a: state.current.get(),
        condition,
    })
}

fn radio(view: &View<'_>, radio: &AboutRadio) -> RadioDetails {
    let mut details = RadioDetails {
        name: radio.name.clone(),
        ..RadioDetails::default()
    };
    let Some(id) = radio.id else {
        return details;
    };
    let counters = view.radio_counters(Some(id));
    let lost = Loss::ALL.into_iter().filter(|why| counters.lost(*why) > 0);
    details.lost = lost
        .map(|why| (why.name().to_owned(), counters.lost(why)))
        .collect();
    (details.sent, details.received) = (Some(counters.sent), Some(counters.received));
    if let Some((state, channel)) = view.radio_state(id) {
        details.state = Some(state_name(state).to_owned());
        let is = |number: &u8| Channel::ieee802154(*number).as_ref() == Some(&channel);
        details.channel = (11..=26).find(is);
    }
    details
}

const fn state_name(state: RadioState) -> &'static str {
    match state {
        RadioState::Transmit => "sending",
        RadioState::Receive => "receiving",
        RadioState::Listen => "listening",
        RadioState::Idle => "idle",
        RadioState::Sleep => "asleep",
    }
}

/// A mount as pages have it.
pub(crate) fn mount(mount: &Mount) -> MountDetails {
    let q = mount.attitude.quat();
    MountDetails {
        at: mount.position.si().to_array(),
        turn: [q.w, q.x, q.y, q.z],
    }
}

/// Beams as pages have them.
pub(crate) fn beams(beams: &Beams) -> BeamsDetails {
    match beams {
        Beams::Rays {
            directions,
            range_m,
        } => BeamsDetails::Rays {
            rays: directions.clone(),
            range_m: *range_m,
        },
        Beams::Cone {
            half_angle_rad,
            range_m,
        } => BeamsDetails::Cone {
            cone: *half_angle_rad,
            range_m: *range_m,
        },
        Beams::Frustum {
            horizontal_rad,
            vertical_rad,
            range_m,
        } => BeamsDetails::Frustum {
            frustum: [*horizontal_rad, *vertical_rad],
            range_m: *range_m,
        },
        Beams::Ball { range_m } => BeamsDetails::Ball {
            ball: true,
            range_m: *range_m,
        },
    }
}
