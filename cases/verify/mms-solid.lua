-- A neo-Hookean solid whose motion is chosen, and the force and heating that make it move so (manufactured solution).
--
-- The map from places x to where their matter started is x - c t - xi(x, t). Its gradient is 1 - grad xi = 1/F, so that
--     u = F (c + xi_t),   rho = rho0/J,   J = det F,   B = F F^T J^(-2/3),
-- solve the equations of mass and of the stretch V = B^(1/2) as they stand: no source acts on them. The pressure is
-- free, and so is the volume fraction alpha of the solid in a mixture with a fluid, whose masses move like the solid's.
-- Momentum and energy follow with the stress s = -p 1 + share (mu/J) dev B, share rho0 the solid's part of the mass, and
-- with the heating that p and alpha need,
--     force = rho Du/Dt - div s,   heating = Dh/Dt + (h + p) div u,   h = sum alpha_l (p + gamma_l p_inf_l)/(gamma_l - 1).
-- A mixture needs two rates more: of alpha what the closure does not make of div u and of the heat, and of V the
-- opposite of what its solid is squeezed out by, (K/alpha) div u n n^T (docs/decisions/solid-gradient.md).
-- Derivatives are exact: with N = d(grad xi), d any derivative, dF = F N F and dJ/J = tr(N F) (beta dg/(1 - g) is added
-- for the hoop: around the axis or the centre F is 1/(1 - g), xi_r = r g).
--
-- Parameters of the case: beta (0 Cartesian, 1 axisymmetric, 2 spherical), a (size of xi), k and phi (g = a cos^4(k r +
-- phi) h(z, t), flat at the walls), period, gamma, p_inf, mu, rho0, c_x, c_y; share (1: no fluid), gamma_f, p_inf_f.
local sin, cos, sqrt, pi = math.sin, math.cos, math.sqrt, math.pi
local w, om = 2 * pi, 2 * pi / period

-- xi and its derivatives in the plane: first those of grad xi by x, y, t, then xi_t and its own.
local function plane(x, y, t)
  local sx, cx, sy, cy = sin(w * x), cos(w * x), sin(w * y), cos(w * y)
  local s1, c1, s2, c2 = sin(om * t), cos(om * t), sin(om * t + 1), cos(om * t + 1)
  local se, ce, sf, cf = sin(w * y + om * t), cos(w * y + om * t), sin(w * x - om * t), cos(w * x - om * t)
  local a1, a2, b1, b2 = a, 0.5 * a, -0.6 * a, 0.7 * a
  return {
    x1 = a1 * w * cx * cy * c1, y1 = -a1 * w * sx * sy * c1 + a2 * w * ce,
    x2 = -b1 * w * sx * sy * s2 - b2 * w * sf, y2 = b1 * w * cx * cy * s2,
    xx1 = -a1 * w * w * sx * cy * c1, xy1 = -a1 * w * w * cx * sy * c1, yy1 = -a1 * w * w * sx * cy * c1 - a2 * w * w * se,
    xx2 = -b1 * w * w * cx * sy * s2 - b2 * w * w * cf, xy2 = -b1 * w * w * sx * cy * s2, yy2 = -b1 * w * w * cx * sy * s2,
    xt1 = -a1 * w * om * cx * cy * s1, yt1 = a1 * w * om * sx * sy * s1 - a2 * w * om * se,
    xt2 = -b1 * w * om * sx * sy * c2 + b2 * w * om * cf, yt2 = b1 * w * om * cx * cy * c2,
    t1 = -a1 * om * sx * cy * s1 + a2 * om * ce, t2 = b1 * om * cx * sy * c2 + b2 * om * sf,
    tt1 = -a1 * om * om * sx * cy * c1 - a2 * om * om * se, tt2 = -b1 * om * om * cx * sy * s2 - b2 * om * om * cf,
    g = 0, gx = 0, gy = 0, gt = 0,
  }
end

-- The same with xi_r = r g; xi_z = 0 in spherical geometry.
local function round(r, z, t)
  local e, s = cos(k * r + phi), sin(k * r + phi)
  local C, C1 = e ^ 4, -4 * k * e ^ 3 * s
  local C2 = 12 * k * k * e * e * s * s - 4 * k * k * e ^ 4
  local se, ce = sin(w * z + om * t), cos(w * z + om * t)
  local w = beta == 1 and w or 0
  local h, hz, ht = a * (cos(om * t) + 0.5 * se), a * 0.5 * w * ce, a * om * (-sin(om * t) + 0.5 * ce)
  local hzz, hzt, htt = -a * 0.5 * w * w * se, -a * 0.5 * w * om * se, a * om * om * (-cos(om * t) - 0.5 * se)
  local A = beta == 1 and 0.3 * a or 0
  local cr, sr, sg, cg = cos(pi * r), sin(pi * r), sin(w * z - om * t), cos(w * z - om * t)
  local R, R1, R2 = r * C, C + r * C1, 2 * C1 + r * C2
  return {
    x1 = R1 * h, y1 = R * hz, x2 = -A * pi * sr * sg, y2 = A * w * cr * cg,
    xx1 = R2 * h, xy1 = R1 * hz, yy1 = R * hzz,
    xx2 = -A * pi * pi * cr * sg, xy2 = -A * pi * w * sr * cg, yy2 = -A * w * w * cr * sg,
    xt1 = R1 * ht, yt1 = R * hzt, xt2 = A * pi * om * sr * cg, yt2 = A * w * om * cr * sg,
    t1 = R * ht, t2 = -A * om * cr * cg, tt1 = R * htt, tt2 = -A * om * om * cr * sg,
    g = C * h, gx = C1 * h, gy = C * hz, gt = C * ht,
  }
end

-- The pressure and its derivatives.
local function pressure(x, y, t)
  if beta == 0 then
    local e, f = w * (x - y) + om * t + 0.3, w * (x + y)
    return 1 + 0.2 * sin(e) + 0.1 * cos(f), 0.2 * w * cos(e) - 0.1 * w * sin(f), -0.2 * w * cos(e) - 0.1 * w * sin(f),
      0.2 * om * cos(e)
  end
  local e = w * y + om * t + 0.3
  return 1 + 0.2 * cos(pi * x) * sin(e) + 0.1 * cos(w * x), -0.2 * pi * sin(pi * x) * sin(e) - 0.1 * w * sin(w * x),
    0.2 * w * cos(pi * x) * cos(e), 0.2 * om * cos(pi * x) * cos(e)
end

-- The fraction of the solid and its derivatives.
local function fraction(x, y, t)
  if share == 1 then return 1, 0, 0, 0 end
  local e, f = w * x + om * t, w * y - om * t
  return 0.5 + 0.15 * sin(e) + 0.15 * cos(f), 0.15 * w * cos(e), -0.15 * w * sin(f),
    0.15 * om * cos(e) + 0.15 * om * sin(f)
end

-- F (2 x 2) and what follows from it.
local function solid(x, y, t)
  local m = (beta == 0 and plane or round)(x, y, t)
  local H11, H12, H21, H22 = 1 - m.x1, -m.y1, -m.x2, 1 - m.y2
  local det = H11 * H22 - H12 * H21
  m.F11, m.F12, m.F21, m.F22 = H22 / det, -H12 / det, -H21 / det, H11 / det
  m.hoop = 1 / (1 - m.g)
  m.J = m.hoop ^ beta / det
  m.v1, m.v2 = c_x + m.t1, c_y + m.t2
  m.u1, m.u2 = m.F11 * m.v1 + m.F12 * m.v2, m.F21 * m.v1 + m.F22 * m.v2
  local iso = m.J ^ (-2 / 3)
  m.B11, m.B22 = iso * (m.F11 ^ 2 + m.F12 ^ 2), iso * (beta == 2 and m.hoop ^ 2 or m.F21 ^ 2 + m.F22 ^ 2)
  m.B12, m.B33 = iso * (m.F11 * m.F21 + m.F12 * m.F22), iso * m.hoop ^ 2
  return m
end

-- Derivatives along d: N = d grad xi, v = d xi_t, g = d g. Of u, log J and s' + p of the solid: xx, yy, zz, xy.
local function along(m, n11, n12, n21, n22, v1, v2, g)
  local F11, F12, F21, F22 = m.F11, m.F12, m.F21, m.F22
  local a11, a12, a21, a22 = n11 * F11 + n12 * F21, n11 * F12 + n12 * F22, n21 * F11 + n22 * F21, n21 * F12 + n22 * F22
  local f11, f12 = F11 * a11 + F12 * a21, F11 * a12 + F12 * a22
  local f21, f22 = F21 * a11 + F22 * a21, F21 * a12 + F22 * a22
  local u1 = f11 * m.v1 + f12 * m.v2 + F11 * v1 + F12 * v2
  local u2 = f21 * m.v1 + f22 * m.v2 + F21 * v1 + F22 * v2
  local hoop = g / (1 - m.g)
  local J = a11 + a22 + beta * hoop
  local iso, fall = m.J ^ (-2 / 3), -2 / 3 * J
  local b11 = iso * 2 * (F11 * f11 + F12 * f12) + fall * m.B11
  local b12 = iso * (f11 * F21 + F11 * f21 + f12 * F22 + F12 * f22) + fall * m.B12
  local b33 = (2 * hoop + fall) * m.B33
  local b22 = beta == 2 and b33 or iso * 2 * (F21 * f21 + F22 * f22) + fall * m.B22
  local G, third, mean = share * mu / m.J, (b11 + b22 + b33) / 3, (m.B11 + m.B22 + m.B33) / 3
  return u1, u2, J, G * (b11 - third - J * (m.B11 - mean)), G * (b22 - third - J * (m.B22 - mean)),
    G * (b12 - J * m.B12)
end

-- V = B^(1/2): its part in the plane (from Cayley and Hamilton's theorem), and zz.
local function stretch(m)
  local root = sqrt(m.B11 * m.B22 - m.B12 ^ 2)
  local per = 1 / sqrt(m.B11 + m.B22 + 2 * root)
  return (m.B11 + root) * per, (m.B22 + root) * per, m.B12 * per, sqrt(m.B33)
end

local function state(x, y)
  local m, alpha = solid(x, y, 0), fraction(x, y, 0)
  local rho, xx, yy, xy, zz = rho0 / m.J, stretch(m)
  local result = {
    pressure = pressure(x, y, 0), density_solid = share * rho / alpha, alpha_solid = alpha, velocity_x = m.u1,
    stretch_xx = xx, stretch_yy = beta == 2 and zz or yy, stretch_zz = zz,
  }
  if beta < 2 then result.velocity_y, result.stretch_xy = m.u2, xy end
  if share < 1 then result.density_fluid = (1 - share) * rho / (1 - alpha) end
  return result
end

-- What a mixture needs beside: rates of the fraction and, by V X + X V = M B + B M, of the stretch.
local function mixture(m, p, div, heat, alpha, a_x, a_y, Dalpha, result)
  local stiff, stiff_f = gamma * (p + p_inf), gamma_f * (p + p_inf_f)
  local soft, soft_f = alpha / stiff, (1 - alpha) / stiff_f
  local all, own = soft + soft_f, soft * (gamma - 1) * heat
  local K = alpha * (1 / (all * stiff) - 1)
  local rate = Dalpha - K * div - own + soft / all * (own + soft_f * (gamma_f - 1) * heat)
  result.alpha_solid, result.alpha_fluid = rate, -rate
  local xx, yy, xy, zz = stretch(m)
  local q, square = -K / alpha * div, a_x ^ 2 + a_y ^ 2
  local m11, m22, m12 = q * (a_x ^ 2 / square - 1 / 3), q * (a_y ^ 2 / square - 1 / 3), q * a_x * a_y / square
  local c11, c22 = 2 * (m11 * m.B11 + m12 * m.B12), 2 * (m12 * m.B12 + m22 * m.B22)
  local c12 = m11 * m.B12 + m12 * m.B22 + m12 * m.B11 + m22 * m.B12
  local t, d = xx + yy, xx * yy - xy * xy
  local a, b, c = 0.5 / t + 0.5 * t / d, 0.5 / (d * t), -0.5 / d
  local h11, h12, h21, h22 = xx * c11 + xy * c12, xx * c12 + xy * c22, xy * c11 + yy * c12, xy * c12 + yy * c22
  result.stretch_xx = a * c11 + b * (h11 * xx + h12 * xy) + 2 * c * h11
  result.stretch_yy = a * c22 + b * (h21 * xy + h22 * yy) + 2 * c * h22
  result.stretch_xy = a * c12 + b * (h11 * xy + h12 * yy) + c * (h12 + h21)
  result.stretch_zz = -q / 3 * zz
end

local function sources(x, y, t)
  local m = solid(x, y, t)
  local p, p_x, p_y, p_t = pressure(x, y, t)
  local alpha, a_x, a_y, a_t = fraction(x, y, t)
  local u_x, v_x, J_x, xx_x, yy_x, xy_x = along(m, m.xx1, m.xy1, m.xx2, m.xy2, m.xt1, m.xt2, m.gx)
  local u_y, v_y, J_y, xx_y, yy_y, xy_y = along(m, m.xy1, m.yy1, m.xy2, m.yy2, m.yt1, m.yt2, m.gy)
  local u_t, v_t = along(m, m.xt1, m.yt1, m.xt2, m.yt2, m.tt1, m.tt2, m.gt)
  local rho, u, v, G, div = rho0 / m.J, m.u1, m.u2, share * mu / m.J, u_x + v_y
  local Dp, Dalpha = p_t + u * p_x + v * p_y, a_t + u * a_x + v * a_y
  local result = { force_x = rho * (u_t + u * u_x + v * u_y) + p_x - xx_x - xy_y }
  if beta > 0 then
    div = div + beta * u / x
    result.force_x = result.force_x - beta * G * (m.B11 - m.B33) / x
  end
  if beta < 2 then
    result.force_y = rho * (v_t + u * v_x + v * v_y) + p_y - xy_x - yy_y - beta * G * m.B12 / x
  end
  local h, h_f = (p + gamma * p_inf) / (gamma - 1), (p + gamma_f * p_inf_f) / (gamma_f - 1)
  result.heating = Dalpha * (h - h_f) + (alpha / (gamma - 1) + (1 - alpha) / (gamma_f - 1)) * Dp
    + (alpha * h + (1 - alpha) * h_f + p) * div
  if share < 1 then mixture(m, p, div, result.heating, alpha, a_x, a_y, Dalpha, result) end
  return result
end

return function(x, y, z, t)
  if t then return sources(x, y, t) end
  return state(x, y)
end
