//! Drives a medium by itself, as the engine would: broadcasts once a second, every radio listening.

use super::topology::Node;
use serde::Serialize;
use simbeeotic_kernel::{ModelId, SimTime};
use simbeeotic_radio::{Ieee802154Medium, Medium, Poses, RadioId, Request, Scratch};
use simbeeotic_units::{Attitude, Pose};
use std::sync::Arc;

/// What became of the broadcasts on one topology.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub(super) struct Tally {
    /// Broadcasts asked for.
    pub(super) requests: u64,
    /// Given up because the channel stayed busy.
    pub(super) access_failures: u64,
    /// Put on the air.
    pub(super) transmitted: u64,
    /// Received, counted at each receiver.
    pub(super) delivered: u64,
    /// Delivered over transmitted times the number of the others; `None` if nothing was transmitted.
    pub(super) ratio: Option<f64>,
    /// From the request to the first bit on the air, of what was transmitted, ms.
    pub(super) mean_access_delay_ms: Option<f64>,
}

/// Nodes that stay where they are.
struct Still(Vec<Pose>);

impl Still {
    fn at(nodes: &[Node]) -> Self {
        let pose = |node: &Node| Pose::new(node.position, Attitude::IDENTITY);
        Self(nodes.iter().map(pose).collect())
    }
}

impl Poses for Still {
    fn pose(&self, owner: ModelId) -> Pose {
        self.0[owner.index()]
    }
}

/// Lets each node ask for one broadcast a second up to `until`, and goes on until the last is through.
/// Radio `i` of the medium is that of node `i`, which model `i` owns.
pub(super) fn drive(
    medium: &mut Ieee802154Medium,
    nodes: &[Node],
    payload_bytes: usize,
    until: SimTime,
) -> Tally {
    let poses = Still::at(nodes);
    let payload: Arc<[u8]> = Arc::from(vec![0; payload_bytes]);
    let mut requests = requests(nodes, until).peekable();
    let (mut asked, mut delivered) = (0, 0);
    let (mut owners, mut scratch) = (Vec::new(), Scratch::new());
    loop {
        let next = requests.peek().map(|&(time, _)| time);
        let Some(now) = [next, medium.next_time()].into_iter().flatten().min() else {
            break;
        };
        medium.open(now, &poses, &mut owners);
        for &owner in &owners {
            let inbox = medium.collect(RadioId(owner.0), &poses, &mut scratch);
            delivered += inbox.len() as u64;
        }
        while let Some(&(_, node)) = requests.peek().filter(|&&(time, _)| time == now) {
            requests.next();
            asked += 1;
            let request = Request::broadcast(RadioId(node as u32), Arc::clone(&payload));
            medium.submit(now, request);
        }
    }

    let access = medium.access_statistics();
    let others = nodes.len() as f64 - 1.0;
    let transmitted = access.transmitted as f64;
    let over = |x: f64, y: f64| (y > 0.0).then(|| x / y);
    Tally {
        requests: asked,
        access_failures: access.failures,
        transmitted: access.transmitted,
        delivered,
        ratio: over(delivered as f64, transmitted * others),
        mean_access_delay_ms: over(access.delay.secs() * 1e3, transmitted),
    }
}

/// Who asks when, in the order of time: each node at its phase in each second.
fn requests(nodes: &[Node], until: SimTime) -> impl Iterator<Item = (SimTime, usize)> {
    let mut order: Vec<(u64, usize)> = nodes
        .iter()
        .enumerate()
        .map(|(index, node)| (node.phase_ns, index))
        .collect();
    order.sort_unstable();
    (0..)
        .flat_map(move |second: u64| {
            let order = order.clone();
            order.into_iter().map(move |(phase_ns, node)| {
                let second = SimTime::from_secs(second);
                (second.saturating_add_nanos(phase_ns), node)
            })
        })
        .take_while(move |&(time, _)| time < until)
}

#[cfg(test)]
mod tests {
    use super::*;
    use simbeeotic_units::Position;

    fn node(number: u64, phase_ns: u64) -> Node {
        Node {
            number,
            position: Position::default(),
            phase_ns,
        }
    }

    #[test]
    fn each_node_asks_once_a_second_at_its_phase() {
        let nodes = [node(0, 700), node(1, 5), node(2, 0)];
        let until = SimTime::from_nanos(2_000_000_005);
        let asked: Vec<(u64, usize)> = requests(&nodes, until)
            .map(|(time, node)| (time.nanos(), node))
            .collect();
        assert_eq!(
            asked,
            [
                (0, 2),
                (5, 1),
                (700, 0),
                (1_000_000_000, 2),
                (1_000_000_005, 1),
                (1_000_000_700, 0),
                (2_000_000_000, 2),
            ]
        );
    }
}
