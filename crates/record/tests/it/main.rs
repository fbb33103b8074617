//! Recordings from outside: what is written can be read, whatever happens in between.

mod child;
mod damage;
mod export;
mod full_disk;
mod killed;
mod readings;
mod round_trip;
mod stage;
mod swarm;
