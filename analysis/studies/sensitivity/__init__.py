"""What drives a campaign's metrics: rank correlations of any trials, Sobol' indices of a plan of their own."""
