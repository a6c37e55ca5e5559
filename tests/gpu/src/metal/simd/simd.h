// What naga's modules include of Metal beside its standard library: they use nothing of it.
