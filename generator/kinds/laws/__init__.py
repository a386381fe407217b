"""Contains one file for each law of contact, friction or film."""
