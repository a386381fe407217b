"""`python -m gudgeon`: the command, where its script is not on the path."""

from gudgeon.entry import main

main()
