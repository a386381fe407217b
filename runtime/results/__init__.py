"""Represent results of runs; the folders below write results as files, figures and reports."""
