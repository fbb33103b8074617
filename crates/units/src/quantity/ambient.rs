//! Light, rain, vortices, and what is mixed into the air.

use super::define::{linear_quantity, quantity};
use super::{Length, Scale};

linear_quantity! {
    /// Light that falls on a surface, inside in lux.
    Illuminance = "an illuminance" {
        "lx": Scale::ONE => from_lux, lux;
        "klx": Scale::times(1e3);
        "mlx": Scale::over(1e3);
    }
}

linear_quantity! {
    /// Light that a source sends in one direction, inside in candelas.
    LuminousIntensity = "a luminous intensity" {
        "cd": Scale::ONE => from_candelas, candelas;
        "kcd": Scale::times(1e3);
        "mcd": Scale::over(1e3);
    }
}

linear_quantity! {
    /// Depth of water that rain would leave on flat ground per time, inside in millimetres per hour.
    ///
    /// Drizzle is below 1 mm/h, heavy rain above 10 mm/h, a cloudburst above 50 mm/h.
    RainRate = "a rain rate" {
        "mm/h": Scale::ONE => from_millimetres_per_hour, millimetres_per_hour;
        "mm/min": Scale::times(60.0);
    }
}

linear_quantity! {
    /// Mass of a gas or smell in a volume of air, inside in kilograms per cubic metre.
    Concentration = "a concentration" {
        "kg/m^3": Scale::ONE => from_kilograms_per_cubic_metre, kilograms_per_cubic_metre;
        "g/m^3": Scale::over(1e3);
        "mg/m^3": Scale::over(1e6) => from_milligrams_per_cubic_metre, milligrams_per_cubic_metre;
        "ug/m^3": Scale::over(1e9) => from_micrograms_per_cubic_metre, micrograms_per_cubic_metre;
    }
}

linear_quantity! {
    /// Mass that a source gives off per time, inside in kilograms per second.
    MassRate = "a mass rate" {
        "kg/s": Scale::ONE => from_kilograms_per_second, kilograms_per_second;
        "g/s": Scale::over(1e3) => from_grams_per_second, grams_per_second;
        "mg/s": Scale::over(1e6) => from_milligrams_per_second, milligrams_per_second;
        "ug/s": Scale::over(1e9);
        "g/h": Scale::over(3.6e6);
    }
}

linear_quantity! {
    /// The circulation of a vortex, or a diffusivity, inside in square metres per second.
    Circulation = "a circulation" {
        "m^2/s": Scale::ONE => from_square_metres_per_second, square_metres_per_second;
        "cm^2/s": Scale::over(1e4);
    }
}

impl LuminousIntensity {
    /// What falls on a surface that faces the source at a distance: the inverse square.
    pub fn at(self, distance: Length) -> Illuminance {
        Illuminance::si(self.get() / (distance.get() * distance.get()))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn light_fades_with_the_square_of_the_distance() {
        let lamp = LuminousIntensity::from_candelas(100.0);
        assert_eq!(lamp.at(Length::si(1.0)), Illuminance::from_lux(100.0));
        assert_eq!(lamp.at(Length::si(10.0)), Illuminance::from_lux(1.0));
    }

    #[test]
    fn units_are_worth_what_they_should() {
        assert_eq!("30 mm/h".parse(), Ok(RainRate::si(30.0)));
        assert_eq!("0.5 mm/min".parse(), Ok(RainRate::si(30.0)));
        assert_eq!(
            "3.6 g/h".parse(),
            Ok(MassRate::from_milligrams_per_second(1.0))
        );
        assert_eq!("5 mg/m³".parse(), Ok(Concentration::si(5e-6)));
        assert_eq!("1.5 klx".parse(), Ok(Illuminance::si(1500.0)));
    }
}
