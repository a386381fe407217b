"""What the commands do; `gudgeon.cli` says how they are called. One file a command."""
