//! Simbeeotic: the log of a run: MCAP recording, CSV and Parquet export.
