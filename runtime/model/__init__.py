"""Prepare a compiled scene for runs: arrays for C, parameter values, default step."""
