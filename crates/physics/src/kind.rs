//! What a body counts as for those who look.

use std::fmt;

/// What a body is, for those who look at it. It has nothing to do with whom a body collides with
/// ([`group`](crate::group)): each body is of one kind, and whoever looks says which kinds it sees.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
#[repr(u8)]
pub enum Kind {
    /// The plane of the ground.
    Ground,
    /// Uneven ground.
    Terrain,
    /// Something in the way.
    Obstacle,
    /// A wall or a slab.
    Structure,
    /// A flower, or a patch of them.
    Flower,
    /// A person.
    Person,
    /// What flies or drives by forces of its own.
    Vehicle,
    /// What belongs to the swarm and does not move by itself: a hive, a beacon.
    Station,
    /// What is moved from outside.
    Ghost,
}

impl Kind {
    /// All of them, in their order.
    pub const ALL: [Self; 9] = [
        Self::Ground,
        Self::Terrain,
        Self::Obstacle,
        Self::Structure,
        Self::Flower,
        Self::Person,
        Self::Vehicle,
        Self::Station,
        Self::Ghost,
    ];

    /// The words for them in files, in their order: all things of a kind.
    pub const PLURALS: [&'static str; 9] = [
        "ground",
        "terrain",
        "obstacles",
        "structures",
        "flowers",
        "people",
        "vehicles",
        "stations",
        "ghosts",
    ];

    /// The word for one thing of the kind.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Ground => "ground",
            Self::Terrain => "terrain",
            Self::Obstacle => "obstacle",
            Self::Structure => "structure",
            Self::Flower => "flower",
            Self::Person => "person",
            Self::Vehicle => "vehicle",
            Self::Station => "station",
            Self::Ghost => "ghost",
        }
    }

    /// The word in files for all things of the kind.
    #[must_use]
    pub const fn plural(self) -> &'static str {
        Self::PLURALS[self as usize]
    }
}

/// Some of the [`Kind`]s; all by default.
#[derive(Clone, Copy, PartialEq, Eq)]
pub struct Kinds(u16);

impl Kinds {
    /// No kind.
    pub const NONE: Self = Self(0);
    /// Every kind.
    pub const ALL: Self = Self((1 << Kind::ALL.len()) - 1);

    /// These, and no others.
    #[must_use]
    pub fn of(kinds: &[Kind]) -> Self {
        kinds.iter().fold(Self::NONE, |all, kind| all.with(*kind))
    }

    /// These and `kind`.
    #[must_use]
    pub const fn with(self, kind: Kind) -> Self {
        Self(self.0 | 1 << kind as u8)
    }

    /// These but `kind`.
    #[must_use]
    pub const fn without(self, kind: Kind) -> Self {
        Self(self.0 & !(1 << kind as u8))
    }

    /// Whether `kind` is one of them.
    #[must_use]
    #[inline]
    pub const fn contains(self, kind: Kind) -> bool {
        self.0 >> kind as u8 & 1 != 0
    }

    /// Those that these are, in the order of [`Kind::ALL`].
    pub fn iter(self) -> impl Iterator<Item = Kind> {
        Kind::ALL
            .into_iter()
            .filter(move |kind| self.contains(*kind))
    }
}

impl Default for Kinds {
    fn default() -> Self {
        Self::ALL
    }
}

impl fmt::Debug for Kinds {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_set().entries(self.iter()).finish()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn kinds_stand_in_their_order_and_each_has_its_place() {
        for (at, kind) in Kind::ALL.into_iter().enumerate() {
            assert_eq!(kind as usize, at);
            assert!(Kinds::ALL.contains(kind));
            assert!(!Kinds::ALL.without(kind).contains(kind));
            assert_eq!(Kinds::of(&[kind]).iter().collect::<Vec<_>>(), [kind]);
        }
        assert_eq!(Kinds::of(&Kind::ALL), Kinds::ALL);
        assert_eq!(Kind::Person.plural(), "people");
    }
}
