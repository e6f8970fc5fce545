"""python -m berth --version"""

import argparse

import berth


def main() -> None:
    parser = argparse.ArgumentParser(prog="python -m berth", description=berth.__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--version", action="version", version=f"berth {berth.__version__}")
    parser.parse_args()
    parser.print_help()


if __name__ == "__main__":
    main()
