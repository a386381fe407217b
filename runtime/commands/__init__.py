"""Implement the commands of `gudgeon`; `gudgeon.cli` defines their arguments. One file a command."""
