"""One file a law of contact, friction or film."""
