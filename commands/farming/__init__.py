"""``burnish conform`` over many machines, by the scheduler of Dask."""
