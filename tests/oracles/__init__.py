"""Oracles: what the product must compute, by other means. Nothing in here imports gudgeon."""
