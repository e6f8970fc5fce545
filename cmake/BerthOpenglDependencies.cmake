# What the component opengl needs besides; an installed berth asks for it only where its user asks for that component.
pkg_check_modules(berth_epoxy REQUIRED IMPORTED_TARGET epoxy)
