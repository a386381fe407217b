"""Run the command by `python -m gudgeon`, where its script is not on the path."""

from gudgeon.entry import main

main()
