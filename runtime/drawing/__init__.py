"""Draw a mechanism with engineering symbols: shapes in metres first, then SVG, matplotlib, TikZ or DXF."""
