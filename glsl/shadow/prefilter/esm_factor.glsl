float log_space_factor() { return esm_exponent; }
