// Finished.
