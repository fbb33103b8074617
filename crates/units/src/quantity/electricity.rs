//! Energy, and the current that brings it.

use super::Scale;
use super::define::{linear_quantity, quantity};

linear_quantity! {
    /// A power, inside in watts.
    Power = "a power" {
        "W": Scale::ONE => from_watts, watts;
        "kW": Scale::times(1e3);
        "mW": Scale::over(1e3) => from_milliwatts, milliwatts;
        "uW": Scale::over(1e6);
    }
}

linear_quantity! {
    /// An energy, inside in joules. Not a [`Charge`]: `charge * voltage` is an energy.
    Energy = "an energy" {
        "J": Scale::ONE => from_joules, joules;
        "kJ": Scale::times(1e3);
        "mJ": Scale::over(1e3) => from_millijoules, millijoules;
        "uJ": Scale::over(1e6);
        "Wh": Scale::times(3600.0) => from_watt_hours, watt_hours;
        "mWh": Scale::ratio(36.0, 10.0);
    }
}

linear_quantity! {
    /// An electric current, inside in amperes.
    Current = "a current" {
        "A": Scale::ONE => from_amperes, amperes;
        "mA": Scale::over(1e3) => from_milliamperes, milliamperes;
        "uA": Scale::over(1e6) => from_microamperes, microamperes;
    }
}

linear_quantity! {
    /// An electric charge, inside in coulombs (ampere seconds): what a battery holds and what
    /// flying takes out of it.
    Charge = "a charge" {
        "C": Scale::ONE => from_coulombs, coulombs;
        "mA s": Scale::over(1e3) => from_milliampere_seconds, milliampere_seconds;
        "mAh": Scale::ratio(36.0, 10.0) => from_milliampere_hours, milliampere_hours;
        "A h": Scale::times(3600.0) => from_ampere_hours, ampere_hours;
    }
}

linear_quantity! {
    /// An electric voltage, inside in volts.
    Voltage = "a voltage" {
        "V": Scale::ONE => from_volts, volts;
        "mV": Scale::over(1e3) => from_millivolts, millivolts;
    }
}

linear_quantity! {
    /// An electric resistance, inside in ohms.
    Resistance = "a resistance" {
        "ohm": Scale::ONE => from_ohms, ohms;
        "mohm": Scale::over(1e3) => from_milliohms, milliohms;
    }
}

linear_quantity! {
    /// An electric conductivity, inside in siemens per metre: of a ground, of water.
    Conductivity = "a conductivity" {
        "S/m": Scale::ONE => from_siemens_per_metre, siemens_per_metre;
        "mS/m": Scale::over(1e3);
    }
}
