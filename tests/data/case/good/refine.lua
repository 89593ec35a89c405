-- A moving window: parameters may be named in any order.
return function(t, x, pressure)
  return x < 1500 * t and pressure or 0
end
