// A weighted mean of texels of a filtered map; the weights add up to 1. With LOG_SPACE a texel holds log(m) / c of the
// mean m of exp(c · depth) over what it covers, and the mean of texels is that of their exponentials, computed without
// their overflow (Salvi 2008, Rendering filtered shadows with exponential shadow maps).
struct Mean {
  vec4 sum;
#if LOG_SPACE
  float greatest;  // the sum is that of exp(c · (value - greatest))
#endif
};

#if LOG_SPACE
Mean no_mean() { return Mean(vec4(0.0), 0.0); }  // no depth is less than 0

Mean with_value(Mean mean, vec4 value, float weight) {
  float greatest = max(mean.greatest, value.x);
  mean.sum.x = mean.sum.x * exp(log_space_factor() * (mean.greatest - greatest)) +
               weight * exp(log_space_factor() * (value.x - greatest));
  mean.greatest = greatest;
  return mean;
}

vec4 result_of(Mean mean) { return vec4(mean.greatest + log(mean.sum.x) / log_space_factor()); }
#else
Mean no_mean() { return Mean(vec4(0.0)); }

Mean with_value(Mean mean, vec4 value, float weight) {
  mean.sum += weight * value;
  return mean;
}

vec4 result_of(Mean mean) { return mean.sum; }
#endif
