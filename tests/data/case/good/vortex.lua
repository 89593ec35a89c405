-- a state at rest with a dip in density
return function(x, y, z)
  return {density = 1 - 0.5 * math.exp(-x * x - y * y), pressure = 1, velocity_x = 0, velocity_y = 0}
end
