# To be sourced by run.
check_postgres() { :; }
