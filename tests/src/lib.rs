//! Shared statistics of the tests.
