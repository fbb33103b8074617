//! The connections that are open: so many at a time, and who must go when another one comes.

use std::collections::BTreeMap;
use std::net::{IpAddr, Ipv6Addr, Shutdown, TcpStream};
use std::sync::{Mutex, PoisonError};

/// Connections at a time, pages included: each has a thread.
const CONNECTIONS_MAX: usize = 64;

/// Connections at a time of one other machine.
const OF_ONE_MAX: usize = 16;

/// The connections that are open.
#[derive(Default)]
pub(super) struct Door(Mutex<Open>);

#[derive(Default)]
struct Open {
    last: u64,
    /// By their numbers: the oldest first.
    all: BTreeMap<u64, Visitor>,
}

struct Visitor {
    stream: TcpStream,
    peer: IpAddr,
    /// Whether it has made a request that was let in.
    admitted: bool,
}

impl Door {
    /// A number for a new connection. If there are too many, the oldest that has not made a request yet is
    /// closed; `None`: all have.
    pub(super) fn open(&self, stream: &TcpStream, peer: IpAddr) -> Option<u64> {
        let stream = stream.try_clone().ok()?;
        let peer = machine(peer);
        let mut open = self.0.lock().unwrap_or_else(PoisonError::into_inner);
        let of_it = open.all.values().filter(|visitor| visitor.peer == peer);
        if !peer.is_loopback() && of_it.count() >= OF_ONE_MAX {
            open.make_room(|visitor| visitor.peer == peer)?;
        }
        if open.all.len() >= CONNECTIONS_MAX {
            open.make_room(|_| true)?;
        }
        open.last += 1;
        let number = open.last;
        let visitor = Visitor {
            stream,
            peer,
            admitted: false,
        };
        open.all.insert(number, visitor);
        Some(number)
    }

    /// It has made a request that was let in, and stays until it is answered.
    pub(super) fn admitted(&self, number: u64) {
        let mut open = self.0.lock().unwrap_or_else(PoisonError::into_inner);
        if let Some(visitor) = open.all.get_mut(&number) {
            visitor.admitted = true;
        }
    }

    /// It is over.
    pub(super) fn forget(&self, number: u64) {
        let mut open = self.0.lock().unwrap_or_else(PoisonError::into_inner);
        open.all.remove(&number);
    }

    pub(super) fn close_all(&self) {
        let open = self.0.lock().unwrap_or_else(PoisonError::into_inner);
        for visitor in open.all.values() {
            let _ = visitor.stream.shutdown(Shutdown::Both);
        }
    }
}

impl Open {
    /// Closes the oldest of some that has not made a request.
    fn make_room(&mut self, of: impl Fn(&Visitor) -> bool) -> Option<()> {
        let mut all = self.all.iter();
        let (number, _) = all.find(|(_, visitor)| !visitor.admitted && of(visitor))?;
        let number = *number;
        let visitor = self.all.remove(&number)?;
        // Its thread reads the end, and ends.
        let _ = visitor.stream.shutdown(Shutdown::Both);
        Some(())
    }
}

/// What counts as one machine: an address, and of IPv6 a network, whose addresses are all its own.
fn machine(peer: IpAddr) -> IpAddr {
    match peer.to_canonical() {
        IpAddr::V6(ip) if !ip.is_loopback() => {
            Ipv6Addr::from_bits(ip.to_bits() & !u128::from(u64::MAX)).into()
        }
        ip => ip,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::net::{Ipv4Addr, TcpListener};

    fn streams(test: impl FnOnce(&TcpStream)) {
        let listener = TcpListener::bind((Ipv4Addr::LOCALHOST, 0)).expect("a port");
        let at = listener.local_addr().expect("an address");
        test(&TcpStream::connect(at).expect("connects"));
    }

    #[test]
    fn the_oldest_silent_one_goes_and_those_with_requests_stay() {
        streams(|stream| {
            let (door, here) = (Door::default(), IpAddr::from(Ipv4Addr::LOCALHOST));
            let first = door.open(stream, here).expect("room");
            door.admitted(first);
            for _ in 0..200 {
                let number = door.open(stream, here).expect("silent ones go");
                let open = door.0.lock().expect("alive");
                assert!(open.all.len() <= CONNECTIONS_MAX);
                assert!(open.all.contains_key(&first) && open.all.contains_key(&number));
            }
            let all: Vec<u64> = door.0.lock().expect("alive").all.keys().copied().collect();
            all.iter().for_each(|number| door.admitted(*number));
            assert_eq!(door.open(stream, here), None);
            door.forget(first);
            assert!(door.open(stream, here).is_some());
        });
    }

    #[test]
    fn one_machine_has_not_all_connections() {
        streams(|stream| {
            let door = Door::default();
            let peer = |text: &str| text.parse::<IpAddr>().expect("an address");
            for k in 0..OF_ONE_MAX {
                let number = door.open(stream, peer(&format!("2001:db8::{k:x}")));
                door.admitted(number.expect("room"));
            }
            assert_eq!(door.open(stream, peer("2001:db8::ffff")), None);
            assert!(door.open(stream, peer("2001:db8:0:1::1")).is_some());
            assert!(door.open(stream, peer("192.168.0.7")).is_some());
        });
    }
}
