//! Radios: their data sheets as functions from settings to numbers.

pub mod at86rf23x;
pub mod cc2420;
pub mod generic;
pub mod nrf24;
pub mod nrf51;
pub mod sx127x;
