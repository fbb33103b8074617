//! Timers as models see them.

/// One timer of a model.
///
/// Declared in `build` ([`Kit::every`](crate::Kit::every), [`Kit::once`](crate::Kit::once),
/// [`Kit::timer`](crate::Kit::timer)) or created later ([`Cx::after`](crate::host::Cx::after)).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct TimerHandle(u32);

impl TimerHandle {
    pub(crate) const fn new(index: u32) -> Self {
        Self(index)
    }

    pub(crate) const fn index(self) -> u32 {
        self.0
    }
}

/// A method that timers may call, declared by [`Kit::call`](crate::Kit::call).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Call(pub(crate) u16);

impl Call {
    /// The host's control law, which is nobody's method.
    pub(crate) const CONTROL: Self = Self(u16::MAX);

    /// A battery may have come to a threshold.
    pub(crate) const BATTERY: Self = Self(u16::MAX - 1);

    /// Calls from here on are those of sensors: a sample is due or arrives.
    const SENSORS: u16 = 0x8000;

    /// A sensor's sample is due, or arrives. `None` for more sensors than calls.
    pub(crate) fn sensor(index: usize) -> Option<Self> {
        let call = Self::SENSORS.checked_add(u16::try_from(index).ok()?)?;
        (call < Self::BATTERY.0).then_some(Self(call))
    }

    /// Which sensor's it is, if one's.
    pub(crate) fn as_sensor(self) -> Option<u16> {
        (self.0 < Self::BATTERY.0)
            .then(|| self.0.checked_sub(Self::SENSORS))
            .flatten()
    }
}
