"""Where independent runs are carried out: in this process, in processes of this machine, or on those of a Dask cluster."""
