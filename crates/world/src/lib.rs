//! Simbeeotic: what is there: ground, obstacles, structures, flowers, people, weather.
