//! Simbeeotic: the shelf: vehicles, behaviours, sensors, radios, weather, hive.
