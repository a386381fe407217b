"""Read and write files: written completely or not at all, and trusted only if no other user could change them."""
